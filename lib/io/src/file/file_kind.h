#pragma once

#include "file/bytes.h"

#include <optional>
#include <string_view>

namespace bdpt::io {

/// What a file is that was expected to be JSON and is not, with its article ("a PNG image", "an
/// empty file"), by its first bytes; none if it may be JSON or is nothing known.
[[nodiscard]] std::optional<std::string_view> other_kind(ByteView file);

}  // namespace bdpt::io
