#include "machine/machine_limits.h"

#include <bdpt/error.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::job::memory_limit_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

void write(const ScratchFolder& root, const std::string& name, const std::string& text)
{
    const fs::path file = root / name;
    fs::create_directories(file.parent_path());
    test::write_text(file, text + "\n");
}

TEST_CASE("the memory of the machine is the least that anything lets the process have", "[cgroup]")
{
    const ScratchFolder root;
    CHECK(machine_memory(root.path()).bytes > std::uint64_t{1} << 60U);  // nobody says anything
    write(root, "proc/meminfo",
          "MemTotal:       24000000 kB\nMemFree:         1000000 kB\nMemAvailable:   20000000 kB");
    const io::MemoryLimit available = machine_memory(root.path());
    CHECK(available.bytes == std::uint64_t{20'000'000} * 1024);
    CHECK(available.source == "free memory of the machine");
    CHECK(available.code == ErrorCode::out_of_memory);
    write(root, "proc/self/cgroup", "0::/task");
    write(root, "sys/fs/cgroup/task/memory.max", "3000000000");
    const io::MemoryLimit container = machine_memory(root.path());
    CHECK(container.bytes == 3'000'000'000);
    CHECK(container.source.find("container") != std::string::npos);
    write(root, "sys/fs/cgroup/task/memory.max", "30000000000");
    CHECK(machine_memory(root.path()).bytes == available.bytes);
}

#ifndef BDPT_SANITIZED  // sanitizers reserve terabytes
TEST_CASE("what is left of the address space is a limit of memory", "[cgroup]")
{
    const ScratchFolder root;
    write(root, "proc/self/status", "VmPeak:  9000000 kB\nVmSize:  1000000 kB");
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
    rlimit less = before;
    less.rlim_cur = rlim_t{1} << 36U;
    REQUIRE(::setrlimit(RLIMIT_AS, &less) == 0);
    const io::MemoryLimit limit = machine_memory(root.path());
    REQUIRE(::setrlimit(RLIMIT_AS, &before) == 0);
    CHECK(limit.bytes == (std::uint64_t{1} << 36U) - std::uint64_t{1'000'000} * 1024);
    CHECK(limit.source.find("ulimit -v") != std::string::npos);
}
#endif

TEST_CASE("the option --max-memory lowers the limit of memory, and never raises it", "[cgroup]")
{
    const io::MemoryLimit machine = memory_limit(std::nullopt);
    const io::MemoryLimit asked = memory_limit(1000);
    CHECK(asked.bytes == 1000);
    CHECK(asked.source == "--max-memory");
    CHECK(asked.code == ErrorCode::invalid_input);
    CHECK(memory_limit(std::uint64_t{1} << 62U).bytes == machine.bytes);
}

TEST_CASE("scenes may take half of the machine's memory, and more if that is asked for", "[cgroup]")
{
    std::ifstream stream("/proc/meminfo");
    std::string word;
    std::uint64_t installed = 0;  // [kB]
    REQUIRE(stream >> word >> installed);
    REQUIRE(word == "MemTotal:");
    const std::uint64_t half = installed * 1024 / 2;
    const std::uint64_t machine = memory_limit(std::nullopt).bytes;
    CHECK(scene_memory_limit(std::nullopt).bytes == std::min(half, machine));
    CHECK(scene_memory_limit(half + half / 2).bytes == std::min(half + half / 2, machine));
    CHECK(scene_memory_limit(1000).bytes == 1000);
}

}  // namespace
}  // namespace bdpt::job::memory_limit_test
