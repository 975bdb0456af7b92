#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <filesystem>
#include <functional>

namespace bdpt::io {

/// Returns how many bytes of a stream that starts with these are worth reading.
using WorthReading = std::function<std::uint64_t(ByteView start)>;

/// Reads an input named by the caller: a file like `read_file`, or all of the standard input, "-",
/// which is read once and kept, so that it can be requested again. URIs in files are not read by
/// this function: "-" is a file for them. Throws `Error` as `read_file`, also not_found if the
/// standard input is a terminal. An endless standard input is read no further than `worth` says.
[[nodiscard]] Bytes read_named(const std::filesystem::path& file, std::uint64_t limit,
                               const WorthReading& worth = {},
                               const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
