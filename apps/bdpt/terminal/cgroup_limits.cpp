#include "terminal/cgroup_limits.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

namespace bdpt::app {
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

}  // namespace bdpt::app
