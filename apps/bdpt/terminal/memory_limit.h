#pragma once

#include <bdpt/io/memory_budget.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bdpt::app {

/// The least of what the machine has free, what the control groups of the process may have and what
/// its address space has left (ulimit -v). `root` is where the files of the system are.
[[nodiscard]] io::MemoryLimit machine_memory(const std::filesystem::path& root = "/");

/// The less of `asked`, which is --max-memory [bytes], and of what the machine had when this was
/// first called: what this process gives back may stay with it.
[[nodiscard]] io::MemoryLimit memory_limit(std::optional<std::uint64_t> asked);

}  // namespace bdpt::app
