#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace bdpt::io {

/// The whole of a regular file. Throws `Error`: not_found when it is missing, not a regular file or
/// unreadable, invalid_input when it is larger than `limit` bytes. Messages do not name the file.
[[nodiscard]] Bytes read_file(const std::filesystem::path& file, std::uint64_t limit);

/// A number of bytes for people, such as "48 TB".
[[nodiscard]] std::string human_bytes(long double bytes);

}  // namespace bdpt::io
