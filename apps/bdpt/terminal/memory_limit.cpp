#include "terminal/memory_limit.h"

#include <bdpt/error.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "terminal/cgroup_limits.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Returns line `name` of a file with lines such as "MemAvailable:   23456 kB" [bytes].
std::optional<std::uint64_t> read_line(const fs::path& file, const std::string& name)
{
    std::ifstream stream(file);
    for (std::string word; stream >> word;) {
        if (std::uint64_t kilobytes = 0; word == name && stream >> kilobytes) {
            return kilobytes * 1024;
        }
    }
    return std::nullopt;
}

/// Returns the memory that the process may still add to its address space.
std::optional<std::uint64_t> address_space(const fs::path& root)
{
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return std::nullopt;
    }
    const std::uint64_t used = read_line(root / "proc/self/status", "VmSize:").value_or(0);
    return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

}  // namespace

io::MemoryLimit machine_memory(const fs::path& root)
{
    io::MemoryLimit least{.bytes = std::numeric_limits<std::uint64_t>::max(),
                          .source = "maximum of 64 bits",
                          .code = ErrorCode::out_of_memory};
    const auto add = [&](std::optional<std::uint64_t> bytes, const char* source) {
        if (bytes && *bytes < least.bytes) {
            least.bytes = *bytes;
            least.source = source;
        }
    };
    add(read_line(root / "proc/meminfo", "MemAvailable:"), "free memory of the machine");
    add(cgroup_limits(root).memory, "memory limit of the container or control group");
    add(address_space(root), "address space of the process, ulimit -v");
    return least;
}

io::MemoryLimit memory_limit(std::optional<std::uint64_t> asked)
{
    static const io::MemoryLimit machine = machine_memory();
    if (!asked || machine.bytes < *asked) {
        return machine;
    }
    return {.bytes = *asked, .source = "--max-memory"};
}

io::MemoryLimit scene_memory_limit(std::optional<std::uint64_t> asked)
{
    const io::MemoryLimit limit = memory_limit(asked);
    const auto installed = read_line("/proc/meminfo", "MemTotal:");
    if (asked || !installed || limit.bytes <= *installed / 2) {
        return limit;
    }
    return {.bytes = *installed / 2,
            .source = "half of the machine's memory; --max-memory allows more",
            .code = ErrorCode::out_of_memory};
}

}  // namespace bdpt::app
