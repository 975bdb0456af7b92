#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bdpt::app {

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

}  // namespace bdpt::app
