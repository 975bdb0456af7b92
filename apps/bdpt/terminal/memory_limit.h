#pragma once

#include <bdpt/io/memory_budget.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bdpt::app {

/// Returns the minimum of the machine's free memory, the limit of the process's control groups and
/// the rest of its address space (ulimit -v). `root` is the root of the system's files.
[[nodiscard]] io::MemoryLimit machine_memory(const std::filesystem::path& root = "/");

/// Returns the minimum of `asked`, which is --max-memory [bytes], and of the machine's memory when
/// this was first called, as freed memory may stay with this process.
[[nodiscard]] io::MemoryLimit memory_limit(std::optional<std::uint64_t> asked);

/// Returns the limit for scenes: that of `memory_limit`, but unless asked for more at most half of
/// the machine's memory. Small files can be large scenes, and other programs run there, too.
[[nodiscard]] io::MemoryLimit scene_memory_limit(std::optional<std::uint64_t> asked);

}  // namespace bdpt::app
