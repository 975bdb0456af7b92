#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "image_files.h"
#include "output/render_report.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::inspect_test {
namespace {

using Words = std::vector<std::string>;

Outcome inspect(const ScratchFolder& folder, const Words& more)
{
    Words words{"inspect", (folder / "cube.gltf").string(), "--size", "16x16"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

}  // namespace

TEST_CASE("inspect tells the paths of a sample and what strategies bring", "[inspect]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    const Outcome text = inspect(folder, {"--pixel", "8,8", "--integrator", "bdpt"});
    REQUIRE(text.exit_code == 0);
    for (const char* part : {"pixel 8,8, sample 0", "camera path", "light path", "strategy"}) {
        CHECK(text.out.find(part) != std::string::npos);
    }
    const Outcome json =
        inspect(folder, {"--pixel", "8,8", "--integrator", "mis", "--sample", "3", "--json"});
    REQUIRE(json.exit_code == 0);
    const auto report = nlohmann::json::parse(json.out);
    CHECK(report["sample"] == 3);
    CHECK(report["settings"]["integrator"] == "mis");
    CHECK(report["camera_path"][0]["on"] == "lens");
    double sum = 0.0;
    for (const auto& found : report["contributions"]) {
        sum += found["weight"].get<double>() * found["unweighted"][0].get<double>();
    }
    CHECK(sum == Approx(report["value"][0].get<double>()));
}

TEST_CASE("inspect tells the samples of a render with as many", "[inspect]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    const std::string exr = (folder / "cube.exr").string();
    const std::string samples = GENERATE("4", "16");
    REQUIRE(run({"render", (folder / "cube.gltf").string(), "--size", "16x16", "--integrator",
                 "mis", "--spp", samples, "-o", exr})
                .exit_code == 0);
    float sum = 0.0f;
    for (int index = 0; index < std::stoi(samples); ++index) {
        const Outcome json =
            inspect(folder, {"--pixel", "8,8", "--integrator", "mis", "--spp", samples, "--sample",
                             std::to_string(index), "--json"});
        REQUIRE(json.exit_code == 0);
        sum += nlohmann::json::parse(json.out)["value"][1].get<float>();
    }
    CHECK(sum / std::stof(samples) == Approx(read_exr(exr).image.at(8, 8).g).epsilon(1e-5));
}

TEST_CASE("columns of long numbers do not run together", "[inspect]")
{
    InspectedSample sample;
    sample.contributions.push_back({.strategy = {.s = 1, .t = 2},
                                    .unweighted = Rgb(1.236e-5f),
                                    .weight = 1.0f,
                                    .shares = {0.0f, 1.0f}});
    const std::string text = job::inspect_text(sample, {}, DVec3(0.0));
    CAPTURE(text);
    CHECK(text.find(" 1.236e-05  s=1 1") != std::string::npos);
    CHECK(text.find(" 1.236e-05           1 ") != std::string::npos);
}

TEST_CASE("inspect draws the directions at a vertex", "[inspect]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    const std::string exr = (folder / "d.exr").string();
    REQUIRE(inspect(folder, {"--pixel", "8,8", "--width", "32", "-o", exr}).exit_code == 0);
    CHECK(read_exr(exr).image.width == 32);
    CHECK(read_exr_channel(exr, "light_pdf.G").size() == 32 * 16);
    const std::string png = (folder / "d.png").string();
    REQUIRE(inspect(folder, {"--pixel", "8,8", "--width", "64", "-o", png}).exit_code == 0);
    CHECK(std::filesystem::file_size(png) > 1000);
}

TEST_CASE("inspect refuses pixels, vertices and files that there are not", "[inspect]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    const auto refused = [&](const Words& words, const std::string& what) {
        const Outcome outcome = inspect(folder, words);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(what) != std::string::npos);
        CHECK(outcome.out.empty());
    };
    refused({}, "--pixel");
    refused({"--pixel", "8"}, "--pixel \"8\"");
    refused({"--pixel", "8,-1"}, "--pixel");
    refused({"--pixel", "16,0"}, "pixel 16,0 is outside of the image");
    refused({"--pixel", "0,0", "-o", "a.jpg"}, "a.jpg");
    refused({"--pixel", "0,0", "--width", "33"}, "--width \"33\"");
    refused({"--pixel", "8,8", "--vertex", "900", "-o", (folder / "a.png").string()}, "vertex 900");
    refused({"--pixel", "8,8", "--integrator", "vcm"}, "vcm");
    CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace bdpt::test::inspect_test
