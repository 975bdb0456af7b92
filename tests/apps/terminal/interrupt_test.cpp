#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "run/run_render.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"
#include "terminal/console.h"

namespace bdpt::test::interrupt_test {
namespace {

/// A render that nobody waits for.
std::vector<std::string> endless(const ScratchFolder& folder, const std::string& size)
{
    return {"render", write_cube(folder, "cube", {}).string(),
            "--spp",  "2000000000",
            "--size", size,
            "-o",     (folder / "out.exr").string()};
}

/// Stops a render when it first asks how it is to be stopped: after the scene is loaded.
class StopAfterLoading final : public app::Interrupt {
public:
    void set_outputs(app::PendingOutputs /*outputs*/) override {}
    void allow_stop() override {}
    void forbid_stop() override {}
    [[nodiscard]] std::stop_token stop_token() const override
    {
        source_.request_stop();
        return source_.get_token();
    }
    [[nodiscard]] std::optional<std::string> stopped_by() const override
    {
        return source_.stop_requested() ? std::optional<std::string>("the test") : std::nullopt;
    }
    [[nodiscard]] bool take_checkpoint_request() override { return false; }

private:
    mutable std::stop_source source_;
};

TEST_CASE("a stop after loading, before the first pass, writes nothing")
{
    const ScratchFolder folder;
    app::RenderArguments arguments;
    arguments.file = write_cube(folder, "cube", {});
    arguments.outputs = {folder / "out.exr"};
    arguments.size = app::Size{16, 8};
    arguments.goal.samples = 1;
    arguments.memory.bytes = std::uint64_t{1} << 30U;
    arguments.options.integrator = GENERATE(IntegratorKind::automatic, IntegratorKind::bdpt);
    app::TerminalConsole console(app::Format::text, app::Verbosity::quiet);
    StopAfterLoading interrupt;
    const JobResult result = job::run_render(arguments, {"bdpt", "render"}, console, interrupt);
    CHECK(interrupt.stopped_by());
    CHECK(result.stopped);
    CHECK(result.images.empty());
    CHECK_FALSE(std::filesystem::exists(folder / "out.exr"));
}

TEST_CASE("a signal finishes the pass, writes the image and sets the exit code")
{
    const int signal_number = GENERATE(SIGINT, SIGTERM, SIGHUP);
    const ScratchFolder folder;
    std::vector<std::string> words = endless(folder, "32x18");
    words.emplace_back("--json");
    Subprocess command(Launch{.arguments = words});
    command.wait_for("\"progress\"");
    command.send(signal_number);
    const Outcome outcome = command.finish();

    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 128 + signal_number);
    const std::size_t last_line = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
    const auto done = nlohmann::json::parse(outcome.out.substr(last_line));
    CHECK(done["event"] == "done");
    CHECK(done["stopped_by"] == (signal_number == SIGINT    ? "SIGINT"
                                 : signal_number == SIGTERM ? "SIGTERM"
                                                            : "SIGHUP"));
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf", "out.exr"});

    const ExrFile exr = read_exr(folder / "out.exr");
    CHECK(exr.image.width == 32);
    CHECK(exr.image.at(16, 9).g > 0.0f);
    const int samples = exr.integer("bdpt.spp");
    CHECK(samples > 0);
    CHECK(done["samples"] == samples);
}

TEST_CASE("a second signal ends the render at once, with nothing half-written")
{
    const ScratchFolder folder;
    // One pass of this takes seconds.
    std::vector<std::string> words = endless(folder, "4000x4000");
    words.insert(words.end(), {"--threads", "1"});
    Subprocess command(Launch{.arguments = words});
    command.wait_for("camera auto");
    command.send(SIGINT);
    command.wait_for("stopping after the current pass");
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 128 + SIGTERM);
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf"});
}

TEST_CASE("a terminal that is closed sends SIGHUP more than once, and the image is kept")
{
    const ScratchFolder folder;
    std::vector<std::string> words = endless(folder, "1500x1500");
    words.insert(words.end(), {"--threads", "1"});
    Subprocess command(Launch{.arguments = words});
    command.wait_for("camera auto");
    command.send(SIGHUP);
    command.wait_for("stopping after the current pass");
    command.send(SIGHUP);
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 128 + SIGHUP);
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf", "out.exr"});
}

TEST_CASE("where a stop is forbidden again, a signal ends the process at once")
{
    const ScratchFolder folder;
    write_text(folder / "half.exr", "half");
    const pid_t child = ::fork();
    if (child == 0) {
        app::SignalInterrupt interrupt({.temporaries = {folder / "half.exr"}}, [] {});
        interrupt.allow_stop();
        interrupt.forbid_stop();
        ::kill(::getpid(), SIGTERM);
        ::sleep(60);
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 128 + SIGTERM);
    CHECK(folder.names().empty());
}

TEST_CASE("SIGUSR1 does nothing to a render without a part, and SIGHUP nothing below nohup")
{
    const ScratchFolder folder;
    const int signal_number = GENERATE(SIGUSR1, SIGHUP);
    const bool below_nohup = signal_number == SIGHUP;
    const auto previous = below_nohup ? ::signal(SIGHUP, SIG_IGN) : SIG_DFL;
    std::vector<std::string> words = endless(folder, "32x18");
    words.emplace_back("--json");
    Subprocess command(Launch{.arguments = words});
    if (below_nohup) {
        ::signal(SIGHUP, previous);
    }
    command.wait_for("\"progress\"");
    command.send(signal_number);
    command.wait_for("\"progress\"");
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 128 + SIGTERM);
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf", "out.exr"});
}

}  // namespace
}  // namespace bdpt::test::interrupt_test
