#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace bdpt::io {

/// A regular file, or its first `most` bytes. Throws `Error`: not_found when it is missing, not a
/// regular file or unreadable, invalid_input when it is larger than `limit` bytes. Messages do not
/// name the file.
[[nodiscard]] Bytes read_file(const std::filesystem::path& file, std::uint64_t limit,
                              std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// A number of bytes for people, such as "48 TB".
[[nodiscard]] std::string human_bytes(long double bytes);

}  // namespace bdpt::io
