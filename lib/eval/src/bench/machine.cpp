#include <bdpt/eval/bench.h>

#include <tbb/info.h>

#include <fstream>
#include <sstream>
#include <string>

#include "bench/bench_parts.h"

namespace bdpt::eval {

namespace {

std::string cpu_model()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return {};
}

std::string system_name()
{
    std::string type;
    std::string release;
    std::ifstream("/proc/sys/kernel/ostype") >> type;
    std::ifstream("/proc/sys/kernel/osrelease") >> release;
    return type.empty() ? std::string() : type + " " + release;
}

}  // namespace

MachineFacts machine_facts()
{
    return {.cpu = cpu_model(),
            .processors = tbb::info::default_concurrency(),
            .system = system_name(),
            .compiler = BDPT_BENCH_COMPILER,
            .libraries = BDPT_BENCH_LIBRARIES};
}

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
