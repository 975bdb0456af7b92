#include <bdpt/eval/bench.h>

#include <tbb/info.h>

#include <fstream>

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

}  // namespace bdpt::eval
