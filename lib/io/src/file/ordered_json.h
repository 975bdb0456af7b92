#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

#include <nlohmann/json.hpp>

#include <string>

namespace bdpt::io {

/// JSON whose objects keep the order of the text. Finding a key takes time in proportion to their
/// number.
using OrderedJson = nlohmann::ordered_json;

/// The same as `parse_json`.
[[nodiscard]] OrderedJson parse_ordered_json(ByteView text, const ReadLimits& limits);

/// The value in a few characters, for messages.
[[nodiscard]] std::string brief(const OrderedJson& value);

}  // namespace bdpt::io
