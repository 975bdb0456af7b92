#include "bench/resources.h"

#include <fstream>
#include <sstream>
#include <string>

namespace bdpt::eval {

void reset_peak_memory()
{
    // "5" resets VmHWM [Linux, Documentation/filesystems/proc.rst, "clear_refs"].
    std::ofstream("/proc/self/clear_refs") << "5";
}

std::optional<std::uint64_t> peak_memory()
{
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("VmHWM:")) {
            std::uint64_t kilobytes = 0;
            std::istringstream(line.substr(6)) >> kilobytes;
            return kilobytes * 1024;
        }
    }
    return std::nullopt;
}

}  // namespace bdpt::eval
