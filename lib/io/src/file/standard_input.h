#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <filesystem>

namespace bdpt::io {

/// What a caller names: a file as `read_file` reads it, or all of the standard input, "-". That is
/// read once and kept, so that it may be asked for again. URIs in files do not come through here:
/// "-" is a file for them. Throws `Error` as `read_file`, also not_found when the standard input is
/// a terminal.
[[nodiscard]] Bytes read_named(const std::filesystem::path& file, std::uint64_t limit);

}  // namespace bdpt::io
