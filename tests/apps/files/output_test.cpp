#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::output_test {
namespace {

TEST_CASE("help and version are worth reading and no errors")
{
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--help"}, {"render", "--help"}, {"info", "--help"}}) {
        const Outcome outcome = run(words);
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        CHECK(outcome.out.find("Examples:") != std::string::npos);
    }
    const std::string help = run({"render", "--help-all"}).out;
    for (const char* word : {"--output",         "--sampler",    "--spp",       "--time",
                             "--size",           "--integrator", "--heuristic", "--max-depth",
                             "--camera",         "--look-at",    "--from",      "--fov",
                             "--scene",          "--env",        "--exposure",  "--threads",
                             "--seed",           "--half",       "--float",     "--quiet",
                             "--json",           "--filter",     "--aov",       "--crop",
                             "--clamp",          "--stats",      "--tiled",     "--strategies",
                             "--strategy-depth", "--contacts",   "--variant",   "--frame-time",
                             "--animation",      "--shutter",    "Exit codes",  "143",
                             "--part",           "--samples",    "--restart"}) {
        CAPTURE(word);
        CHECK(help.find(word) != std::string::npos);
    }
    const Outcome version = run({"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.out.starts_with(std::string("bdpt ") + BDPT_VERSION + "\n"));
    for (const char* part : {"Embree ", "oneTBB ", "OpenEXR ", "Compiler: ", "Instruction set"}) {
        CHECK(version.out.find(part) != std::string::npos);
    }
}

TEST_CASE("all outputs are written, with their size and how they were made")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const Outcome outcome =
        run({"render", scene, "-o", (folder / "a.exr").string(), "-o", (folder / "b.PNG").string(),
             "--spp", "5", "--size", "40x20", "--seed", "12345678901234567890", "--integrator",
             "mis", "--heuristic", "balance", "--sampler", "independent"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(folder.names() == std::set<std::string>{"a.exr", "b.PNG", "cube.bin", "cube.gltf"});

    const ExrFile exr = read_exr(folder / "a.exr");
    CHECK(exr.image.width == 40);
    CHECK(exr.image.height == 20);
    CHECK(exr.header.channels().findChannel("R")->type == Imf::FLOAT);
    CHECK(exr.text("software") == std::string("bdpt ") + BDPT_VERSION);
    CHECK(exr.text("bdpt.scene") == "cube.gltf");
    CHECK(exr.text("bdpt.seed") == "12345678901234567890");
    CHECK(exr.text("bdpt.integrator") == "mis");
    CHECK(exr.integer("bdpt.spp") == 5);
    CHECK(exr.number("bdpt.renderTimeSeconds") > 0.0f);
    CHECK(Imf::hasWorldToNDC(exr.header));
    const auto settings = nlohmann::json::parse(exr.text("bdpt.settings"));
    CHECK(settings["heuristic"] == "balance");
    CHECK(settings["sampler"] == "independent");
    CHECK(settings["spp"] == 5);
    CHECK(settings["environment"] == "object");

    PngFile png = read_png(folder / "b.PNG");
    CHECK(png.width == 40);
    CHECK(png.height == 20);
    CHECK(png.has_srgb_chunk);
    CHECK(png.text["bdpt.settings"] == exr.text("bdpt.settings"));
    CHECK(*std::max_element(png.rgb.begin(), png.rgb.end()) > 100);
}

TEST_CASE("an output replaces an older file")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    write_text(folder / "a.exr", "an older file");
    const Outcome outcome =
        run({"render", scene, "-o", (folder / "a.exr").string(), "--spp", "1", "--size", "8x8"});
    CHECK(outcome.exit_code == 0);
    CHECK(read_exr(folder / "a.exr").image.width == 8);
}

TEST_CASE("option --half stores halves and tells what they could not hold")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "lamp",
                   {.material = R"({"emissiveFactor": [1, 1, 1], "extensions":
                        {"KHR_materials_emissive_strength": {"emissiveStrength": 1e6}}})",
                    .cameras = two_cameras,
                    .more = R"("extensionsUsed": ["KHR_materials_emissive_strength"],)"})
            .string();
    const Outcome outcome = run({"render", scene, "-o", (folder / "a.exr").string(), "--spp", "1",
                                 "--size", "8x4", "--half"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const ExrFile exr = read_exr(folder / "a.exr");
    CHECK(exr.header.channels().findChannel("R")->type == Imf::HALF);
    CHECK(exr.image.at(4, 2).g == 65504.0f);
    CHECK(outcome.err.find("exceed 65504") != std::string::npos);
}

TEST_CASE("option --exposure fixes the brightness of PNG files")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    const auto brightest = [&](const std::string& exposure) {
        const Outcome outcome = run({"render", scene, "-o", (folder / "a.png").string(), "--spp",
                                     "1", "--size", "8x4", "--exposure", exposure});
        REQUIRE(outcome.exit_code == 0);
        const PngFile png = read_png(folder / "a.png");
        return int{*std::max_element(png.rgb.begin(), png.rgb.end())};
    };
    CHECK(brightest("-3") > 0);
    CHECK(brightest("-3") < brightest("-1"));
    CHECK(brightest("10") == 255);
    CHECK(brightest("-40") == 0);
}

TEST_CASE("an image is written where another output cannot be", "[outputs]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    std::filesystem::create_directory(folder / "gone");
    const std::string gone = (folder / "gone" / "x.exr").string();
    const std::string stats = (folder / "gone" / "x.json").string();
    const std::string keep = (folder / "keep.png").string();
    Subprocess command(Launch{.arguments = {"render", scene, "--spp", "2000000000", "--size", "16",
                                            "-o", gone, "-o", keep, "--stats", stats}});
    command.wait_for("camera auto");
    std::filesystem::remove_all(folder / "gone");
    command.send(SIGINT);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 6);
    CHECK(read_png(keep).width == 16);
    CHECK(outcome.err.find("wrote " + keep) != std::string::npos);
    CHECK(outcome.err.find("wrote " + gone) == std::string::npos);
    CHECK(outcome.err.find("bdpt: error: " + gone + ": cannot write") != std::string::npos);
    CHECK(outcome.err.find("; " + stats + ": cannot write") != std::string::npos);
}

TEST_CASE("outputs have the format of their names", "[outputs]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    std::vector<std::string> words{"render", scene, "--spp", "4", "--size", "24x16"};
    for (const char* name : {"a.exr", "a.hdr", "a.png", "a.jpg", "b.JPEG", "a.webp"}) {
        words.insert(words.end(), {"-o", (folder / name).string()});
    }
    const Outcome outcome = run(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    // All show the same: those for screens to the losses of their formats.
    const auto compared = [&](const char* a, const char* b) {
        const Outcome result = run({"compare", (folder / a).string(), (folder / b).string(),
                                    "--json", "--metrics", "rmse", "--quiet"});
        CAPTURE(result.err);
        REQUIRE(result.exit_code == 0);
        return nlohmann::json::parse(result.out)["images"][0]["metrics"]["rmse"].get<double>();
    };
    CHECK(compared("a.hdr", "a.exr") < 0.01);
    CHECK(compared("a.jpg", "a.png") < 0.02);
    CHECK(compared("b.JPEG", "a.jpg") == 0.0);
    CHECK(compared("a.webp", "a.png") < 0.03);
    CHECK(compared("a.png", "a.exr") > 0.03);
    CHECK(read_text(folder / "a.jpg").find("bdpt.settings: {") != std::string::npos);
}

}  // namespace
}  // namespace bdpt::test::output_test
