#include "machine/machine_limits.h"

#include <filesystem>
#include <string>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::job::cgroup_limits_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

void write(const ScratchFolder& root, const std::string& name, const std::string& text)
{
    const fs::path file = root / name;
    fs::create_directories(file.parent_path());
    test::write_text(file, text + "\n");
}

TEST_CASE("quotas of version 2 are the least of all groups around the process", "[cgroup]")
{
    const ScratchFolder root;
    write(root, "proc/self/cgroup", "0::/farm/job/task");
    CHECK_FALSE(cgroup_limits(root.path()).processors);
    write(root, "sys/fs/cgroup/farm/cpu.max", "800000 100000");
    write(root, "sys/fs/cgroup/farm/job/cpu.max", "250000 100000");
    write(root, "sys/fs/cgroup/farm/job/task/cpu.max", "max 100000");
    write(root, "sys/fs/cgroup/farm/job/memory.max", "3000000000");
    write(root, "sys/fs/cgroup/farm/memory.max", "max");
    CHECK(cgroup_limits(root.path()).processors == 3);  // rounded up
    CHECK(cgroup_limits(root.path()).memory == 3'000'000'000);
    write(root, "sys/fs/cgroup/farm/job/task/cpu.max", "50000 100000");
    CHECK(cgroup_limits(root.path()).processors == 1);
    write(root, "sys/fs/cgroup/farm/job/task/memory.max", "2000000000");
    CHECK(cgroup_limits(root.path()).memory == 2'000'000'000);
    // Groups beside ours do not count.
    write(root, "sys/fs/cgroup/farm/other/cpu.max", "10000 100000");
    write(root, "sys/fs/cgroup/farm/job/task/inner/memory.max", "1");
    CHECK(cgroup_limits(root.path()).processors == 1);
    CHECK(cgroup_limits(root.path()).memory == 2'000'000'000);
}

TEST_CASE("quotas of version 1 are found where its controllers are mounted", "[cgroup]")
{
    const ScratchFolder root;
    write(root, "proc/self/cgroup",
          "12:memory:/docker/abc\n4:cpuset:/docker/abc\n3:cpu,cpuacct:/docker/abc\n"
          "1:name=systemd:/docker/abc\n0::/");
    const std::string mount = GENERATE("sys/fs/cgroup/cpu,cpuacct", "sys/fs/cgroup/cpu");
    write(root, mount + "/docker/abc/cpu.cfs_period_us", "50000");
    write(root, mount + "/docker/abc/cpu.cfs_quota_us", "-1");
    write(root, "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
    CHECK_FALSE(cgroup_limits(root.path()).processors);
    CHECK_FALSE(cgroup_limits(root.path()).memory);
    write(root, mount + "/docker/abc/cpu.cfs_quota_us", "100000");
    write(root, "sys/fs/cgroup/memory/docker/abc/memory.limit_in_bytes", "1000000000");
    CHECK(cgroup_limits(root.path()).processors == 2);
    CHECK(cgroup_limits(root.path()).memory == 1'000'000'000);
}

TEST_CASE("in a container the group of the process may be what is mounted", "[cgroup]")
{
    const ScratchFolder root;
    const std::string group = GENERATE("0::/", "0::/not/to/be/seen", "0::/../..");
    write(root, "proc/self/cgroup", group);
    write(root, "sys/fs/cgroup/cpu.max", "400000 100000");
    CHECK(cgroup_limits(root.path()).processors == 4);
}

TEST_CASE("what is no quota is none", "[cgroup]")
{
    const ScratchFolder root;
    CHECK_FALSE(cgroup_limits(root.path()).processors);
    write(root, "proc/self/cgroup", "0::/\nno line of that kind\n7:\n");
    for (const char* text :
         {"", "max", "max 100000", "0 0", "x y", "100000 0", "-5 100000", "99999999999999 1"}) {
        CAPTURE(text);
        write(root, "sys/fs/cgroup/cpu.max", text);
        CHECK_FALSE(cgroup_limits(root.path()).processors);
    }
}

}  // namespace
}  // namespace bdpt::job::cgroup_limits_test
