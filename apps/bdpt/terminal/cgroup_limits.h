#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bdpt::app {

/// What Linux allows the process by control groups, as containers and Slurm set them: the least of
/// its group and of those around it, as far as they can be seen.
struct CgroupLimits {
    std::optional<int> processors{};        ///< quota of CPU time, rounded up; at least 1
    std::optional<std::uint64_t> memory{};  ///< [bytes]
};

/// Those of this process, from /proc/self/cgroup and the files of versions 1 and 2 below
/// /sys/fs/cgroup, in the file system `root` [kernel.org: Control Group v2, CFS Bandwidth Control].
/// What cannot be read is no limit.
[[nodiscard]] CgroupLimits cgroup_limits(const std::filesystem::path& root = "/");

}  // namespace bdpt::app
