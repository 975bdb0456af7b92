#pragma once

#include "file/bytes.h"

#include <bdpt/io/memory_budget.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

namespace bdpt::io {

/// A regular file, or its first `most` bytes. Throws `Error`: not_found when it is missing, not a
/// regular file or unreadable, invalid_input when it is larger than `limit` bytes. Messages do not
/// name the file. Bytes that `memory` does not have are refused as it refuses them.
[[nodiscard]] Bytes read_file(const std::filesystem::path& file, std::uint64_t limit,
                              std::uint64_t most = std::numeric_limits<std::uint64_t>::max(),
                              const MemoryBudget* memory = nullptr);

/// Gives all of a regular file to `visit`, a piece at a time, so that it never is in memory as a
/// whole. Throws `Error` as `read_file`.
void for_each_block(const std::filesystem::path& file, std::uint64_t limit,
                    const std::function<void(ByteView)>& visit);

/// A number of bytes for people, such as "48 TB".
[[nodiscard]] std::string human_bytes(long double bytes);

}  // namespace bdpt::io
