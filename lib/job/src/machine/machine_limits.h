#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace bdpt::job {

/// Limits of the process by Linux control groups, as set by containers and Slurm: the minimum over
/// its group and the enclosing ones, as far as visible.
struct CgroupLimits {
    std::optional<int> processors{};        ///< quota of CPU time, rounded up; at least 1
    std::optional<std::uint64_t> memory{};  ///< [bytes]
};

/// Returns the limits of this process, from /proc/self/cgroup and the files of versions 1 and 2
/// below /sys/fs/cgroup, in the file system `root` [kernel.org: Control Group v2, CFS Bandwidth
/// Control]. Unreadable files impose no limit.
[[nodiscard]] CgroupLimits cgroup_limits(const std::filesystem::path& root = "/");

/// Returns the minimum of the machine's free memory, the limit of the process's control groups and
/// the rest of its address space (ulimit -v). `root` is the root of the system's files.
[[nodiscard]] io::MemoryLimit machine_memory(const std::filesystem::path& root = "/");

/// Returns the minimum of `asked`, which is --max-memory [bytes], and of the machine's memory when
/// this was first called, as freed memory may stay with this process.
[[nodiscard]] io::MemoryLimit memory_limit(std::optional<std::uint64_t> asked);

/// Returns the limit for scenes: that of `memory_limit`, but unless asked for more at most half of
/// the machine's memory. Small files can be large scenes, and other programs run there, too.
[[nodiscard]] io::MemoryLimit scene_memory_limit(std::optional<std::uint64_t> asked);

/// Runs `work` with as many threads as the quota of a container allows, and as the system lets
/// start: oneTBB knows only the processors that the process may run on, not such limits.
void within_quota(const std::function<void()>& work);

}  // namespace bdpt::job
