// --exposure: by the light that falls in, not by what it falls on.

#include <bdpt/image.h>
#include <bdpt/io/write_image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "options/groups/image_arguments.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::exposure_test {
namespace {

using job::ExposureBase;
using job::parse_exposure;
using Words = std::vector<std::string>;

Outcome render(const ScratchFolder& folder, const std::string& scene, const Words& more)
{
    Words words{"render", scene,          "--size", "32x16", "--spp",
                "4",      "--integrator", "mis",    "-o",    (folder / "a.##.png").string()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    CAPTURE(outcome.out, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
}

/// Those of all images [EV].
std::vector<double> exposures(const ScratchFolder& folder, const std::string& scene, Words more)
{
    more.emplace_back("--json");
    std::istringstream lines(render(folder, scene, more).out);
    std::vector<double> result;
    for (std::string line; std::getline(lines, line);) {
        const auto event = nlohmann::json::parse(line);
        if (event.at("event") == "done") {
            result.push_back(event.at("exposure").get<double>());
        }
    }
    return result;
}

/// A rough cube of that albedo, seen from two sides.
std::string cube_of(const ScratchFolder& folder, const std::string& albedo)
{
    return write_cube(
               folder, "cube" + albedo,
               {.material =
                    R"({"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [)" +
                    albedo + "," + albedo + "," + albedo + ",1]}}",
                .cameras = two_cameras})
        .string();
}

/// That of a still image [EV].
double exposure_of_still(const ScratchFolder& folder, const std::string& scene, const Words& more)
{
    Words words{"render", scene,    "--spp",
                "4",      "--json", "--integrator",
                "mis",    "-o",     (folder / "still.png").string()};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
        words.insert(words.end(), {"--size", "32x16"});
    }
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    std::istringstream lines(outcome.out);
    std::optional<double> exposure;
    for (std::string line; std::getline(lines, line);) {
        const auto event = nlohmann::json::parse(line);
        if (event.contains("exposure")) {
            exposure = event.at("exposure").get<double>();
        }
    }
    REQUIRE(exposure.has_value());
    return *exposure;
}

/// An environment that is black but for a bright band around the horizon.
std::filesystem::path write_dark_sky(const ScratchFolder& folder)
{
    Image sky{.width = 16, .height = 8, .pixels = std::vector<Rgb>(std::size_t{16} * 8)};
    std::fill_n(sky.pixels.begin() + 3 * 16, 16, Rgb(20.0f));
    const std::filesystem::path file = folder / "dark-sky.exr";
    io::write_exr(file, sky, {});
    return file;
}

}  // namespace

TEST_CASE("an exposure is a number, or auto or light with perhaps a number behind it")
{
    struct Case {
        const char* text;
        ExposureBase base;
        float value;
    };
    for (const Case& right :
         {Case{"1.5", ExposureBase::radiance, 1.5f}, Case{"+1", ExposureBase::radiance, 1.0f},
          Case{"-2", ExposureBase::radiance, -2.0f}, Case{"auto", ExposureBase::automatic, 0.0f},
          Case{"Auto+1", ExposureBase::automatic, 1.0f}, Case{"light", ExposureBase::light, 0.0f},
          Case{"light-0.5", ExposureBase::light, -0.5f}}) {
        CAPTURE(right.text);
        const auto exposure = parse_exposure(right.text);
        REQUIRE(exposure.has_value());
        CHECK(exposure->base == right.base);
        CHECK(exposure->value == right.value);
    }
    for (const char* wrong : {"", "bright", "light0.5", "light+", "auto 1", "101", "light+101",
                              "nan", "1EV", "+-1", "light++1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_exposure(wrong));
    }
}

TEST_CASE("white, grey and black things have the same exposure by the light on them")
{
    const ScratchFolder folder;
    const Words before{"--background", "white", "--frames", "1:1", "--fps", "1"};
    const auto exposure_of = [&](const char* albedo, const Words& more) {
        Words words = before;
        words.insert(words.end(), more.begin(), more.end());
        return exposures(folder, cube_of(folder, albedo), words).at(0);
    };
    const double grey = exposure_of("0.2", {});
    for (const char* albedo : {"1", "0.01"}) {
        CAPTURE(albedo);
        CHECK(exposure_of(albedo, {}) == Approx(grey).margin(0.1));
        CHECK(std::abs(exposure_of(albedo, {"--exposure", "auto"}) - grey) > 1.0);
    }
    CHECK(exposure_of("0.2", {"--exposure", "light-0.5"}) == Approx(grey - 0.5).margin(1e-4));
    CHECK(exposure_of("0.2", {"--exposure", "+1"}) == 1.0);
    // Twice the light.
    CHECK(exposure_of("0.2", {"--env", "object", "--env-intensity", "2"}) ==
          Approx(grey - 1.0).margin(1e-3));
}

TEST_CASE("things in an environment have the same exposure, whatever their colour")
{
    const ScratchFolder folder;
    const std::string sky = write_dark_sky(folder).string();
    for (const Words& light :
         {Words{}, Words{"--env", "default"}, Words{"--env", "studio"}, Words{"--env", sky}}) {
        const auto exposure = [&](const char* albedo, const Words& more) {
            Words words = light;
            words.insert(words.end(), more.begin(), more.end());
            return exposure_of_still(folder, cube_of(folder, albedo), words);
        };
        const double grey = exposure("0.2", {});
        CHECK(exposure("0.01", {}) == Approx(grey).margin(0.1));
        CHECK(exposure("1", {}) == Approx(grey).margin(0.1));
        const Words automatic{"--exposure", "auto"};
        CHECK(std::abs(exposure("0.01", automatic) - exposure("1", automatic)) > 0.3);
    }
}

TEST_CASE("inside of a scene, and without an environment, the image decides on its exposure")
{
    const ScratchFolder folder;
    for (const char* name : {"room-environment", "cornell-box"}) {
        CAPTURE(name);
        const std::string scene = std::string(BDPT_SOURCE_DIR) + "/scenes/" + name + ".gltf";
        const double by_default = exposure_of_still(folder, scene, {});
        CHECK(by_default == exposure_of_still(folder, scene, {"--exposure", "auto"}));
        CHECK(std::abs(by_default - exposure_of_still(folder, scene, {"--exposure", "light"})) >
              0.3);
    }
}

TEST_CASE("the size of an image changes its exposure as little as its light")
{
    const ScratchFolder folder;
    const std::string framed = write_cube(folder, "framed", {}).string();
    const std::string seen = cube_of(folder, "0.5");  // by a camera of the file
    for (const std::string& scene : {framed, seen}) {
        const double usual = exposure_of_still(folder, scene, {});
        for (const char* size : {"32x24", "16x32", "60x8"}) {
            CAPTURE(scene, size);
            CHECK(exposure_of_still(folder, scene, {"--size", size}) == usual);
        }
    }
}

TEST_CASE("all views of an orbit have one exposure")
{
    const ScratchFolder folder;
    const std::string scene = cube_of(folder, "0.5");
    const std::vector<double> views = exposures(folder, scene, {"--orbit", "4"});
    REQUIRE(views.size() == 4);
    for (const double view : views) {
        CHECK(view == views[0]);
    }
    // The next task starts elsewhere, and has the same.
    CHECK(exposures(folder, scene, {"--orbit", "4", "--frames", "3:4"}).at(0) == views[0]);
    const std::vector<double> automatic =
        exposures(folder, scene, {"--orbit", "4", "--exposure", "auto"});
    CHECK(automatic.at(0) != automatic.at(1));
}

TEST_CASE("what was written is told with its exposure")
{
    const ScratchFolder folder;
    const std::string scene = cube_of(folder, "0.5");
    const Words frame{"--frames", "1:1", "--fps", "1"};
    Words words = frame;
    words.insert(words.end(), {"--exposure", "-1.25"});
    CHECK(render(folder, scene, words).err.find(", exposure -1.25 EV") != std::string::npos);
}

TEST_CASE("develop takes the light that the render has metered, and no other")
{
    const ScratchFolder folder;
    const std::string scene = cube_of(folder, "0.5");
    const std::string image = (folder / "image.exr").string();
    const auto develop = [&](const Words& more) {
        Words words{"develop", image, "-o", (folder / "again.png").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Words frame{"--frames", "1:1", "--fps", "1", "-o", image};
    Words with_background = frame;
    with_background.insert(with_background.end(), {"--background", "white"});
    const double metered = exposures(folder, scene, with_background).at(0);
    const auto developed = [&](const Words& more) {
        Words words = more;
        words.emplace_back("--json");
        return nlohmann::json::parse(develop(words).out).at("exposure").get<double>();
    };
    CHECK(developed({}) == metered);
    CHECK(developed({"--exposure", "light+1"}) == Approx(metered + 1.0));

    const Outcome plain =
        run({"render", scene, "--size", "8x8", "--spp", "1", "--exposure", "auto", "-o", image});
    REQUIRE(plain.exit_code == 0);
    const Outcome refused = develop({"--exposure", "light"});
    CAPTURE(refused.err);
    CHECK(refused.exit_code == 4);
    CHECK(refused.err.find("was not metered") != std::string::npos);
}

}  // namespace bdpt::test::exposure_test
