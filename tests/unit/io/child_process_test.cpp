#include "process/child_process.h"

#include <bdpt/error.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>

#include "catch.hpp"

namespace bdpt::test::child_process_test {
using namespace bdpt::io;

namespace {

constexpr const char* shell = "/bin/sh";

std::string all_of(ChildProcess& process)
{
    std::string text(1 << 20, '\0');
    text.resize(process.read(text.data(), text.size()));
    return text;
}

std::ptrdiff_t open_descriptors()
{
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

bool has_children()
{
    return ::waitpid(-1, nullptr, WNOHANG) != -1;
}

}  // namespace

TEST_CASE("a process writes what is read, and says how it ended", "[volume]")
{
    const std::ptrdiff_t before = open_descriptors();
    {
        ChildProcess process(shell, {"-c",
                                     "printf one; sleep 0.1; printf two; "
                                     "echo first >&2; echo last >&2; exit 3"});
        CHECK(all_of(process) == "onetwo");  // in two pieces: a short read is not the end
        const ProcessEnd end = process.wait();
        CHECK(end.exit_code == 3);
        CHECK(end.signal == 0);
        CHECK(end.message == "last");
    }
    {
        ChildProcess process(shell, {"-c", "kill -SEGV $$"});
        CHECK(all_of(process).empty());
        CHECK(process.wait().signal == SIGSEGV);
    }
    {
        ChildProcess process(shell, {"-c", "cat; ls /proc/self/fd | wc -l"});
        CHECK(std::stoi(all_of(process)) == 4);  // the standard streams, and what ls lists
        CHECK(process.wait().exit_code == 0);
    }
    CHECK_THROWS_AS(ChildProcess("/nowhere/program", {}), Error);
    CHECK(open_descriptors() == before);
    CHECK_FALSE(has_children());
}

TEST_CASE("a process that nobody waits for is ended, and leaves nothing", "[volume]")
{
    {
        const ChildProcess process(shell, {"-c", "exec sleep 1000"});
    }
    CHECK_FALSE(has_children());
    // Who writes more than anybody reads ends by that, though it is ignored here.
    const auto old = ::signal(SIGPIPE, SIG_IGN);
    ChildProcess process("/usr/bin/yes", {});
    std::string text(10, '\0');
    CHECK(process.read(text.data(), text.size()) == 10);
    CHECK(process.wait().signal == SIGPIPE);
    ::signal(SIGPIPE, old);
}

TEST_CASE("a process is read from where signals interrupt, and children are not waited for",
          "[volume]")
{
    struct sigaction quiet {};
    quiet.sa_handler = [](int) {};  // without SA_RESTART
    struct sigaction old {};
    ::sigaction(SIGUSR1, &quiet, &old);
    {
        ChildProcess process(shell, {"-c",
                                     "for i in 1 2 3 4 5; do kill -USR1 $PPID; sleep 0.02; "
                                     "printf x; done"});
        CHECK(all_of(process) == "xxxxx");
        CHECK(process.wait().exit_code == 0);
    }
    ::sigaction(SIGUSR1, &old, nullptr);
    const auto old_child = ::signal(SIGCHLD, SIG_IGN);
    {
        ChildProcess process(shell, {"-c", "printf done; exit 2"});
        CHECK(all_of(process) == "done");
        CHECK(process.wait().exit_code == -1);  // nobody knows
    }
    ::signal(SIGCHLD, old_child);
}

}  // namespace bdpt::test::child_process_test
