#include "machine/machine_limits.h"

#include <bdpt/error.h>
#include <bdpt/thread_limit.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Group of the process in one hierarchy.
struct Group {
    std::string controllers;  ///< "cpu,cpuacct"; empty: version 2
    fs::path path;
};

std::vector<Group> groups_of_process(const fs::path& root)
{
    std::vector<Group> result;
    std::ifstream stream(root / "proc/self/cgroup");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first != std::string::npos && second != std::string::npos) {
            result.push_back({.controllers = line.substr(first + 1, second - first - 1),
                              .path = line.substr(second + 1)});
        }
    }
    return result;
}

bool has_controller(const Group& group, const std::string& name)
{
    return ("," + group.controllers + ",").find("," + name + ",") != std::string::npos;
}

/// Returns the folders of the group and of all enclosing ones. In a container the outermost visible
/// one is mounted, whatever the path of the group says.
std::vector<fs::path> list_folders(const Group& group, const fs::path& mount)
{
    std::vector<fs::path> result{mount};
    std::error_code ignored;
    for (const fs::path& name : group.path.relative_path()) {
        const fs::path folder = result.back() / name;
        if (name == ".." || !fs::is_directory(folder, ignored)) {
            break;
        }
        result.push_back(folder);
    }
    return result;
}

/// Returns the numbers in a file of one line; "max", and negative numbers, mean no limit.
std::vector<double> numbers_in(const fs::path& file)
{
    std::vector<double> result;
    std::ifstream stream(file);
    for (std::string word; stream >> word;) {
        try {
            const double number = std::stod(word);
            result.push_back(number >= 0.0 ? number : unlimited);
        } catch (const std::exception&) {
            result.push_back(unlimited);
        }
    }
    return result;
}

double number_in(const fs::path& file)
{
    const std::vector<double> numbers = numbers_in(file);
    return numbers.size() == 1 ? numbers[0] : unlimited;
}

/// Returns the processors of the group in `folder` alone.
double quota_in(const fs::path& folder)
{
    const std::vector<double> now = numbers_in(folder / "cpu.max");  // version 2
    double quota = now.size() == 2 ? now[0] / now[1] : unlimited;
    const double period = number_in(folder / "cpu.cfs_period_us");
    if (std::isfinite(period)) {
        quota = std::min(quota, number_in(folder / "cpu.cfs_quota_us") / period);
    }
    return quota > 0.0 ? quota : unlimited;
}

double memory_in(const fs::path& folder)
{
    return std::min(number_in(folder / "memory.max"), number_in(folder / "memory.limit_in_bytes"));
}

}  // namespace

CgroupLimits cgroup_limits(const fs::path& root)
{
    // [bytes]; version 1 states a huge number if there is no limit.
    constexpr double no_machine = 0x1p60;
    constexpr double max_processors = 4096.0;
    const fs::path mounts = root / "sys/fs/cgroup";
    double processors = unlimited;
    double memory = unlimited;
    for (const Group& group : groups_of_process(root)) {
        std::vector<fs::path> places;
        if (group.controllers.empty()) {
            places = {mounts, mounts / "unified"};
        } else if (has_controller(group, "cpu") || has_controller(group, "memory")) {
            places = {mounts / group.controllers,
                      mounts / (has_controller(group, "cpu") ? "cpu" : "memory")};
        }
        for (const fs::path& place : places) {
            for (const fs::path& folder : list_folders(group, place)) {
                processors = std::min(processors, quota_in(folder));
                memory = std::min(memory, memory_in(folder));
            }
        }
    }
    CgroupLimits result;
    if (processors < max_processors) {
        result.processors = std::max(1, static_cast<int>(std::ceil(processors)));
    }
    if (memory < no_machine) {
        result.memory = static_cast<std::uint64_t>(memory);
    }
    return result;
}

namespace {

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

void within_quota(const std::function<void()>& work)
{
    const int quota = cgroup_limits().processors.value_or(int{tbb::task_arena::automatic});
    const int available = tbb::this_task_arena::max_concurrency();
    const int allowed = limit_threads(quota > 0 ? std::min(quota, available) : available).allowed;
    if (allowed < available) {
        tbb::task_arena(allowed).execute(work);
    } else {
        work();
    }
}

}  // namespace bdpt::job
