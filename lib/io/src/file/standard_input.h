#pragma once

#include "file/bytes.h"

#include <bdpt/io/memory_budget.h>

#include <cstdint>
#include <filesystem>
#include <functional>

namespace bdpt::io {

/// How many bytes of a stream are worth reading whose first bytes are these.
using WorthReading = std::function<std::uint64_t(ByteView start)>;

/// What a caller names: a file as `read_file` reads it, or all of the standard input, "-". That is
/// read once and kept, so that it may be asked for again. URIs in files do not come through here:
/// "-" is a file for them. Throws `Error` as `read_file`, also not_found when the standard input is
/// a terminal. A standard input that never ends is read no further than `worth` says.
[[nodiscard]] Bytes read_named(const std::filesystem::path& file, std::uint64_t limit,
                               const WorthReading& worth = {},
                               const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
