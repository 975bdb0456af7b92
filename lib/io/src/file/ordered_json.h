#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

#include <nlohmann/json.hpp>

#include <string>

namespace bdpt::io {

/// JSON whose objects keep the order of the text. Finding a key takes time linear in their number.
using OrderedJson = nlohmann::ordered_json;

/// Parses one JSON text, as `parse_json` does.
[[nodiscard]] OrderedJson parse_ordered_json(ByteView text, const ReadLimits& limits);

/// Returns the value in a few characters, for messages.
[[nodiscard]] std::string brief(const OrderedJson& value);

}  // namespace bdpt::io
