#include "terminal/console.h"

#include <limits>

#include "catch.hpp"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::app::console_test {
namespace {

using test::Launch;
using test::Outcome;

TEST_CASE("the time that is left follows samples or time, whichever ends first")
{
    const Progress quarter{.samples_done = 16, .samples_total = 64, .seconds = 10.0};
    CHECK(time_left(quarter, {.samples = 64}) == 30.0);
    CHECK(time_left(quarter, {.samples = 64, .seconds = 25.0}) == 15.0);
    CHECK(time_left(quarter, {.samples = 64, .seconds = 100.0}) == 30.0);
    CHECK(time_left(quarter, {.samples = {}, .seconds = 12.0}) == 2.0);
    CHECK(time_left(quarter, {.samples = {}, .seconds = 5.0}) == 0.0);
    CHECK_FALSE(time_left({}, {.samples = 64}));
}

/// A render that goes on for some passes, and warns that its image will be black.
Launch some_passes(const test::ScratchFolder& folder)
{
    return {.arguments = {"render", write_cube(folder, "cube", {}).string(), "--size", "64x36",
                          "--time", "0.5s", "--env", "none", "-o", (folder / "out.exr").string()}};
}

TEST_CASE("on a terminal there is a progress line with an ETA, in colour if that is wanted")
{
    const test::ScratchFolder folder;
    Launch launch = some_passes(folder);
    launch.stderr_kind = test::StderrKind::terminal;
    launch.environment = {{"TERM", "xterm"}};
    const Outcome plain_terminal = run(launch);
    CAPTURE(plain_terminal.err);
    CHECK(plain_terminal.exit_code == 0);
    CHECK(plain_terminal.out.empty());
    CHECK(plain_terminal.err.find("\r[") != std::string::npos);
    CHECK(plain_terminal.err.find("ETA ") != std::string::npos);
    CHECK(plain_terminal.err.find("\x1b[33mwarning") != std::string::npos);

    launch.environment.emplace("NO_COLOR", "1");
    const Outcome no_color = run(launch);
    CHECK(no_color.err.find("\r[") != std::string::npos);
    CHECK(no_color.err.find("warning: ") != std::string::npos);
    CHECK(no_color.err.find('\x1b') == std::string::npos);

    launch.environment = {{"TERM", "dumb"}};
    CHECK(run(launch).err.find("\r[") == std::string::npos);
}

TEST_CASE("without a terminal there are neither colours nor redrawn lines")
{
    const test::ScratchFolder folder;
    const Outcome outcome = run(some_passes(folder));
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("bdpt: warning: ") != std::string::npos);
    CHECK(outcome.err.find('\x1b') == std::string::npos);
    CHECK(outcome.err.find('\r') == std::string::npos);
}

TEST_CASE("option --quiet prints nothing")
{
    const test::ScratchFolder folder;
    Launch launch = some_passes(folder);
    launch.arguments.emplace_back("--quiet");
    launch.stderr_kind = GENERATE(test::StderrKind::pipe, test::StderrKind::terminal);
    const Outcome outcome = run(launch);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
}

}  // namespace
}  // namespace bdpt::app::console_test
