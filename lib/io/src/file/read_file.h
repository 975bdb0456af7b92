#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

namespace bdpt::io {

/// Reads a regular file, or its first `most` bytes. Throws `Error`: not_found if it is missing, not
/// a regular file or unreadable, invalid_input if it is larger than `limit` bytes. Messages do not
/// name the file. Throws as `memory` does if that does not have the bytes.
[[nodiscard]] Bytes read_file(const std::filesystem::path& file, std::uint64_t limit,
                              std::uint64_t most = std::numeric_limits<std::uint64_t>::max(),
                              const MemoryBudget* memory = nullptr);

/// Passes all of a regular file to `visit` in blocks, so that it is never in memory as a whole.
/// Throws `Error` as `read_file`.
void for_each_block(const std::filesystem::path& file, std::uint64_t limit,
                    const std::function<void(ByteView)>& visit);

/// Formats a number of bytes for people, such as "48 TB".
[[nodiscard]] std::string human_bytes(long double bytes);

}  // namespace bdpt::io
