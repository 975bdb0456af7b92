#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "commands/commands.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::bench_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string box = BDPT_SOURCE_DIR "/scenes/cornell-box.gltf";

/// A benchmark that takes next to no time, with `more` options.
std::vector<std::string> tiny(const ScratchFolder& folder, std::vector<std::string> more = {})
{
    std::vector<std::string> words{
        "bench",  box,       "-o", (folder / "out").string(), "--size", "8x8",           "--time",
        "0.004s", "--seeds", "2",  "--reference-time",        "0.02s",  "--integrators", "pt,bdpt"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::size_t line_count(const std::string& text)
{
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_CASE("a benchmark writes a page, JSON and CSV, and prints a table")
{
    const ScratchFolder folder;
    const Outcome outcome = run(tiny(folder));
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.out.find("cornell-box: 8 x 8 pixels") == 0);
    CHECK(outcome.out.find("\n  pt ") != std::string::npos);
    CHECK(outcome.out.find("\n  bdpt ") != std::string::npos);
    CHECK(outcome.err.find("wrote ") != std::string::npos);
    const json result = json::parse(read_text(folder / "out/bench.json"));
    CHECK(result["scenes"][0]["name"] == "cornell-box");
    CHECK(result["scenes"][0]["complete"] == true);
    CHECK(result["command"].get<std::string>().find("--integrators pt,bdpt") != std::string::npos);
    CHECK(read_text(folder / "out/report.html").find("</html>") != std::string::npos);
    CHECK(read_text(folder / "out/bench.csv").find("\n\"cornell-box\",") != std::string::npos);

    SECTION("and a second time finds all runs")
    {
        const auto first = result["scenes"][0]["runs"];
        REQUIRE(run(tiny(folder)).exit_code == 0);
        CHECK(json::parse(read_text(folder / "out/bench.json"))["scenes"][0]["runs"] == first);
    }
    SECTION("and refuses the folder for other options")
    {
        const Outcome other = run(tiny(folder, {"--max-depth", "3"}));
        CHECK(other.exit_code == 2);
        CHECK(line_count(other.err) == 1);
        CHECK(other.err.find("holds runs with max_depth 64, not 3") != std::string::npos);
    }
    SECTION("and does not take a broken run for good")
    {
        const fs::path file = folder / "out/scenes/cornell-box/bdpt-1.json";
        write_text(file, "{\"integrator\": ");
        const Outcome other = run(tiny(folder));
        CHECK(other.exit_code == 4);
        CHECK(other.err.find(file.string() + ": ") != std::string::npos);
    }
}

TEST_CASE("a benchmark compares denoised images where there is a denoiser")
{
    const ScratchFolder folder;
    const Outcome outcome =
        run({.arguments = tiny(folder), .environment = {{"BDPT_DENOISER", BDPT_FAKE_OIDN}}});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const json one =
        json::parse(read_text(folder / "out/bench.json"))["scenes"][0]["integrators"][1];
    CHECK(one["flip_denoised"]["median"].get<double>() >= 0.0);
    CHECK(one["flip_denoised"]["median"] != one["flip"]["median"]);
}

TEST_CASE("scenes of one name are kept apart")
{
    const ScratchFolder folder;
    std::vector<std::string> words = tiny(folder, {"--quiet", "--strategy-depth", "2"});
    words.insert(words.begin() + 2, box);
    const Outcome outcome = run(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    const json result = json::parse(read_text(folder / "out/bench.json"));
    CHECK(result["scenes"][1]["name"] == "cornell-box-2");
    CHECK(fs::exists(folder / "out/scenes/cornell-box-2/pt-0.exr"));
    const json strategies =
        json::parse(read_text(folder / "out/scenes/cornell-box/strategies.json"));
    CHECK(strategies["depth"] == 2);
}

TEST_CASE("words of a benchmark that make no sense")
{
    const ScratchFolder folder;
    const auto [words, expected] = GENERATE(table<std::vector<std::string>, std::string>(
        {{{"--integrators", "pt,path"},
          "--integrators \"pt,path\": expected a comma-separated list of pt, nee, mis, lt"},
         {{"--integrators", "pt,"}, "--integrators \"pt,\""},
         {{"--time", "fast"}, "--time \"fast\""},
         {{"--reference-time", "-1"}, "--reference-time"},
         {{"--seeds", "0"}, "--seeds"},
         {{"--spp", "0"}, "--spp"},
         {{"--strategy-depth", "99"}, "--strategy-depth"},
         {{"--size", "8x"}, "--size \"8x\""},
         {{"--sampler", "halton"}, "--sampler"},
         {{"--frobnicate"}, "unknown option --frobnicate"}}));
    std::vector<std::string> all{"bench", box, "-o", (folder / "out").string()};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run(all);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find(expected) != std::string::npos);
    CHECK(line_count(outcome.err) == 1);
    CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("one reference does not serve several scenes")
{
    const ScratchFolder folder;
    std::vector<std::string> words = tiny(folder, {"--reference", (folder / "r.exr").string()});
    words.insert(words.begin() + 2, box);
    CHECK(run(words).exit_code == 2);
}

TEST_CASE("what cannot be read or written is told with its exit code")
{
    const ScratchFolder folder;
    SECTION("a missing scene does not take finished ones along")
    {
        std::vector<std::string> words = tiny(folder);
        words.insert(words.begin() + 2, (folder / "none.gltf").string());
        const Outcome outcome = run(words);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.err.find("none.gltf") != std::string::npos);
        const json result = json::parse(read_text(folder / "out/bench.json"));
        REQUIRE(result["scenes"].size() == 1);
        CHECK(result["scenes"][0]["complete"] == true);
        CHECK(fs::exists(folder / "out/report.html"));
    }
    SECTION("a missing reference")
    {
        const Outcome outcome = run(tiny(folder, {"--reference", (folder / "r.exr").string()}));
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.err.find("r.exr") != std::string::npos);
    }
    SECTION("a folder that cannot be made")
    {
        write_text(folder / "out", "a file");
        const Outcome outcome = run(tiny(folder));
        CHECK(outcome.exit_code == 6);
        CHECK(line_count(outcome.err) == 1);
    }
    SECTION("a full disk: the page is too large, the runs are kept")
    {
        const Outcome outcome = run(Launch{.arguments = tiny(folder), .file_size = 24'000});
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 6);
        CHECK(outcome.err.find("report.html") != std::string::npos);
        CHECK(fs::exists(folder / "out/scenes/cornell-box/bdpt-1.json"));
        CHECK(fs::exists(folder / "out/bench.json"));
        CHECK_FALSE(fs::exists(folder / "out/report.html"));
        // With room again nothing is rendered anew.
        const auto runs = json::parse(read_text(folder / "out/bench.json"))["scenes"][0]["runs"];
        REQUIRE(run(tiny(folder)).exit_code == 0);
        CHECK(json::parse(read_text(folder / "out/bench.json"))["scenes"][0]["runs"] == runs);
    }
}

TEST_CASE("a benchmark that is interrupted writes what is finished, and can go on")
{
    const ScratchFolder folder;
    // Some hundred runs; only the first ones are waited for.
    const auto with_seeds = [&](const char* seeds) {
        std::vector<std::string> words = tiny(folder, {"--json"});
        *(std::find(words.begin(), words.end(), "--seeds") + 1) = seeds;
        *(std::find(words.begin(), words.end(), "--time") + 1) = "0.05s";
        return words;
    };
    Subprocess command(Launch{.arguments = with_seeds("2000")});
    command.wait_for("seed 2");
    command.send(SIGINT);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 130);
    const json result = json::parse(read_text(folder / "out/bench.json"));
    CHECK(result["scenes"][0]["complete"] == false);
    const auto runs = result["scenes"][0]["runs"];
    CHECK(runs.size() >= 4);
    CHECK(fs::exists(folder / "out/report.html"));
    CHECK(run(with_seeds("2")).exit_code == 0);
    const auto again = json::parse(read_text(folder / "out/bench.json"))["scenes"][0]["runs"];
    REQUIRE(again.size() == 4);
    for (std::size_t i = 0; i < again.size(); ++i) {
        CHECK(again[i] == runs[i]);
    }
}

TEST_CASE("events of a benchmark are JSON")
{
    const ScratchFolder folder;
    const Outcome outcome = run(tiny(folder, {"--json"}));
    REQUIRE(outcome.exit_code == 0);
    std::istringstream lines(outcome.out);
    std::vector<std::string> events;
    for (std::string line; std::getline(lines, line);) {
        const json event = json::parse(line);
        events.push_back(event["event"].get<std::string>());
        if (events.back() == "progress") {
            CHECK(event["fraction"].get<double>() <= 1.0);
            CHECK(event["activity"].get<std::string>().find("cornell-box: ") == 0);
        }
    }
    REQUIRE(events.size() >= 2);
    CHECK(events[events.size() - 2] == "scene");
    CHECK(events.back() == "done");
}

TEST_CASE("images of a benchmark have the wanted number of pixels and the camera's proportions")
{
    const app::Size wide = app::bench_size({1280, 720}, 40000);
    CHECK(wide.width == 267);
    CHECK(wide.height == 150);
    CHECK(app::bench_size({720, 720}, 9216).width == 96);
    CHECK(app::bench_size({65535, 1}, 100).height == 1);
}

}  // namespace
}  // namespace bdpt::test::bench_test
