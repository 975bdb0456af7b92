#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "messages/text.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::usage_test {
namespace {

using Words = std::vector<std::string>;

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Runs what must be refused as wrong usage, in one line; returns it.
std::string usage_error(const Words& words)
{
    const Outcome outcome = run(words);
    CAPTURE(words, outcome.out, outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    return outcome.err;
}

TEST_CASE("help shows the whole of a value that has a colon")
{
    CHECK(contains(run({"render", "--help-all"}).out, "--filter NAME[:RADIUS]  "));
    CHECK_FALSE(contains(run({"render", "--help"}).out, "--spp N:"));
    CHECK(contains(run({"render", "--help"}).out, "--spp N  "));
}

TEST_CASE("help has what people need first, --help-all the rest")
{
    const std::string help = run({"render", "--help"}).out;
    const std::string all = run({"render", "--help-all"}).out;
    for (const char* option : {"--output", "--time", "--size", "--env", "--help-all"}) {
        CAPTURE(option);
        CHECK(contains(help, option));
        CHECK(contains(all, option));
    }
    for (const char* option : {"--connections", "--isa", "--strategies", "Exit codes:"}) {
        CAPTURE(option);
        CHECK_FALSE(contains(help, option));
        CHECK(contains(all, option));
    }
    CHECK(std::count(help.begin(), help.end(), '\n') <= 45);
    CHECK(run({"render", "scene.glb", "--spp", "4", "--help-all"}).out == all);
    // Behind "--" it is no option.
    CHECK(run({"render", "--", "--help-all"}).exit_code == 3);
}

TEST_CASE("help is as wide as the terminal, within limits")
{
    const auto widest = [](const std::string& text) {
        std::size_t most = 0;
        std::size_t column = 0;
        for (const char c : text) {
            column = c == '\n' ? 0 : column + 1;
            most = std::max(most, column);
        }
        return most;
    };
    CHECK(widest(job::wrapped("one two three four", 9)) == 7);
    CHECK(job::wrapped("one two three four", 9) == "one two\nthree\nfour");
    CHECK(job::wrapped_paragraphs("a b c\nd\n\nTitle:\n  as it is\nend", 3) ==
          "a b\nc d\n\nTitle:\n  as it is\nend\n");
    CHECK(widest(run({"render", "--help"}).out) <= 100);
}

TEST_CASE("each command points to its own help")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string out = (folder / "out").string();
    const auto check = [](const std::string& command, const Words& words) {
        Words all{command};
        all.insert(all.end(), words.begin(), words.end());
        const std::string message = usage_error(all);
        CAPTURE(message);
        CHECK(message.ends_with("; see \"bdpt " + command + " --help\"\n"));
        CHECK((contains(message, ": expected ") || contains(message, " needs ")));
    };
    check("render", {scene, "-o", out + ".exr", "--size", "0x0"});
    check("verify", {scene, "--size", "0x0"});
    check("verify", {scene, "--bias", "0"});
    check("bench", {scene, "-o", out, "--size", "0x0"});
    check("bench", {scene, "-o", out, "--time", "soon"});
    check("info", {scene, "--shutter", "long"});
    check("compare", {out, out, "--scale", "0"});
    check("render", {scene, "-o", out + ".exr", "--focus-distance", "2"});
}

TEST_CASE("a number that must be whole is said to be")
{
    const std::string scene = "scene.gltf";
    const auto message = [&](const std::string& option, const std::string& value) {
        return usage_error({"render", scene, "-o", "out.exr", option, value});
    };
    CHECK(contains(message("--spp", "1.5"),
                   "--spp \"1.5\": expected a whole number from 1 to 2147483648"));
    CHECK(contains(message("--spp", "15e-1"), "whole number"));
    CHECK(contains(message("--threads", "5000"), "whole number from 0 to 4096"));
    CHECK(contains(message("--max-depth", ""), "--max-depth"));
}

TEST_CASE("of an option that is given again, the last one counts")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const Outcome outcome = run({"render",       scene,
                                 "--spp",        "3",
                                 "--size",       "8x8",
                                 "--integrator", "pt",
                                 "--half",       "--half",
                                 "-o",           (folder / "a.exr").string(),
                                 "-o",           (folder / "b.exr").string(),
                                 "--spp",        "2",
                                 "--size",       "6x4",
                                 "--integrator", "mis"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const ExrFile exr = read_exr(folder / "a.exr");
    CHECK(exr.image.width == 6);
    CHECK(exr.integer("bdpt.spp") == 2);
    CHECK(exr.text("bdpt.integrator") == "mis");
    CHECK(read_exr(folder / "b.exr").image.width == 6);
    CHECK(contains(usage_error({"render", scene, scene, "-o", "out.exr"}),
                   "out.exr: several scenes would write it"));
}

TEST_CASE("an output is named once only")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string out = (folder / "o.exr").string();
    CHECK(contains(usage_error({"render", scene, "-o", out, "-o", out}), out));
    const std::string other = (folder / "." / "o.exr").string();
    CHECK(contains(usage_error({"render", scene, "-o", out, "-o", other}), "named twice"));
}

TEST_CASE("an error image must be a PNG file, and nothing else is offered")
{
    const ScratchFolder folder;
    write_text(folder / "a.exr", "never read");
    for (const char* name : {"e.jpg", "e.exr", "e"}) {
        const std::string message =
            usage_error({"compare", (folder / "a.exr").string(), (folder / "a.exr").string(),
                         "--error-image", (folder / name).string()});
        CHECK(contains(message, "expected a file name that ends in .png"));
        CHECK_FALSE(contains(message, "ends in .exr"));
    }
}

TEST_CASE("help and version are commands, too")
{
    const auto same = [](const Words& a, const Words& b) {
        const Outcome first = run(a);
        const Outcome second = run(b);
        CAPTURE(a, first.err);
        CHECK(first.exit_code == 0);
        CHECK(first.err.empty());
        CHECK(first.out == second.out);
    };
    same({"help"}, {"--help"});
    same({"version"}, {"--version"});
    for (const char* command : {"render", "info", "compare", "bench", "verify"}) {
        same({"help", command}, {command, "--help"});
        CHECK(contains(run({"help"}).out, std::string("\n  ") + command));
    }
    CHECK(contains(usage_error({"help", "paint"}), "unknown command \"paint\""));
    CHECK(contains(usage_error({"version", "please"}), "please"));
}

TEST_CASE("with --json, --quiet leaves the result and nothing else")
{
    const ScratchFolder folder;
    // A file that warns.
    const std::string scene =
        write_cube(folder, "cube", {.more = R"("extensionsUsed": ["EXT_not_known"],)"}).string();
    CHECK(contains(run({"render", scene, "-o", (folder / "a.exr").string(), "--spp", "1", "--size",
                        "8x4", "--json"})
                       .out,
                   "EXT_not_known"));
    const Outcome outcome = run({"render", scene, "-o", (folder / "a.exr").string(), "--time", "1s",
                                 "--size", "8x4", "--json", "--quiet"});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(nlohmann::json::parse(outcome.out)["event"] == "done");
    const Outcome failure = run({"render", scene, "-o", (folder / "a.exr").string(), "--camera",
                                 "none", "--json", "--quiet"});
    CHECK(failure.exit_code == 3);
    CHECK(nlohmann::json::parse(failure.out)["event"] == "error");
}

}  // namespace
}  // namespace bdpt::test::usage_test
