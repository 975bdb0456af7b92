// How images look on a screen: tone curves, backgrounds, depth of .png files, and environments that
// are turned.

#include <bdpt/io/display.h>
#include <bdpt/io/write_image.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::display_test {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t center = 8 * 32 + 16;
constexpr std::size_t above = 16;  // in row 0, where the sky is

/// A cube of one nit before a sky, 32 x 16 pixels.
class DisplayFolder {
public:
    DisplayFolder()
        : scene_(
              write_cube(folder_, "cube", {.material = emissive_material, .cameras = two_cameras})
                  .string())
    {}

    /// A sky whose quarters around -z, +x, +z and -x are red, green, blue and grey.
    std::string write_sky() const
    {
        constexpr int width = 64;
        Image sky{width, 32, {}};
        for (int y = 0; y < sky.height; ++y) {
            for (int x = 0; x < width; ++x) {
                const int quarter = ((x + width / 8) / (width / 4) + 2) % 4;
                sky.pixels.push_back(quarter == 0   ? Rgb(1.0f, 0.0f, 0.0f)
                                     : quarter == 1 ? Rgb(0.0f, 1.0f, 0.0f)
                                     : quarter == 2 ? Rgb(0.0f, 0.0f, 1.0f)
                                                    : Rgb(0.5f));
            }
        }
        const std::filesystem::path file = folder_ / "sky.exr";
        io::write_exr(file, sky, {});
        return file.string();
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    Outcome render(const Words& more) const
    {
        Words words{"render", scene_, "--spp", "4", "--size", "32x16", "--integrator", "mis"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    PngFile png(Words more) const
    {
        more.insert(more.end(), {"-o", path("out.png"), "--exposure", "0"});
        check(render(more));
        return read_png(path("out.png"));
    }
    ExrFile exr(Words more) const
    {
        more.insert(more.end(), {"-o", path("out.exr")});
        check(render(more));
        return read_exr(path("out.exr"));
    }
    static void check(const Outcome& outcome)
    {
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

std::vector<std::uint16_t> pixel(const PngFile& file, std::size_t index)
{
    const auto channels = static_cast<std::size_t>(file.channels);
    const auto first = file.values.begin() + static_cast<std::ptrdiff_t>(index * channels);
    return {first, first + file.channels};
}

using Values = std::vector<std::uint16_t>;

TEST_CASE("option --tone-map chooses the curve of .png files")
{
    const DisplayFolder cube;
    for (const io::ToneCurve curve : io::all_tone_curves) {
        const std::string name(io::tone_curve_name(curve));
        PngFile file = cube.png({"--tone-map", name, "--env", "none"});
        const std::uint16_t expected = io::encode_srgb(io::apply(curve, Rgb(1.0f)).g);
        CAPTURE(name);
        CHECK(pixel(file, center)[1] == expected);
        CHECK(file.text["bdpt.toneMap"] == name);
    }
    CHECK(cube.png({}).values == cube.png({"--tone-map", "filmic"}).values);
}

TEST_CASE("option --background transparent leaves out the sky, and says where it was")
{
    const DisplayFolder cube;
    const Words words{"--env", "default", "--tone-map", "none", "--background", "transparent"};
    PngFile file = cube.png(words);
    CHECK(file.channels == 4);
    CHECK(file.bits == 8);
    CHECK(pixel(file, above) == Values{0, 0, 0, 0});
    CHECK(pixel(file, center)[3] == 255);
    CHECK(nlohmann::json::parse(file.text["bdpt.settings"])["background"] == "transparent");
    CHECK(cube.png({"--env", "default"}).channels == 3);

    const ExrFile linear = cube.exr(words);
    const std::vector<float> alpha = read_exr_channel(cube.path("out.exr"), "A");
    CHECK(linear.image.pixels[above] == Rgb(0.0f));
    CHECK(alpha[above] == 0.0f);
    CHECK(alpha[center] == 1.0f);
    // The sky lights the cube as before.
    const ExrFile seen = cube.exr({"--env", "default"});
    CHECK(linear.image.pixels[center] == seen.image.pixels[center]);
    CHECK(seen.image.pixels[above].g > 0.5f);
    CHECK(linear.image.pixels[center].g > 1.2f);
}

TEST_CASE("option --background with a colour puts exactly that colour behind")
{
    const DisplayFolder cube;
    const Words words{"--env", "default", "--tone-map", "agx", "--background"};
    const auto with = [&](const std::string& color, const Words& more = {}) {
        Words all = words;
        all.push_back(color);
        all.insert(all.end(), more.begin(), more.end());
        return cube.png(all);
    };
    CHECK(pixel(with("#2040f1"), above) == Values{0x20, 0x40, 0xf1});
    CHECK(pixel(with("black"), above) == Values{0, 0, 0});
    const PngFile deep = with("#2040F1", {"--png-bits", "16"});
    CHECK(deep.bits == 16);
    CHECK(pixel(deep, above) == Values{0x2020, 0x4040, 0xf1f1});
    CHECK(pixel(deep, center) == pixel(with("black", {"--png-bits", "16"}), center));
}

TEST_CASE("merged parts have the background of their render, or another one")
{
    const DisplayFolder cube;
    const Words words{"--env", "default", "--background", "#2040f1"};
    const PngFile whole = cube.png(words);
    DisplayFolder::check(
        run(Words{"render", cube.path("cube.gltf"), "--size", "32x16", "--integrator", "mis",
                  "--env", "default", "--background", "#2040f1", "--spp", "4", "--samples", "0:2",
                  "--part", cube.path("a.exr")}));
    DisplayFolder::check(
        run(Words{"render", cube.path("cube.gltf"), "--size", "32x16", "--integrator", "mis",
                  "--env", "default", "--background", "black", "--spp", "4", "--samples", "2:4",
                  "--part", cube.path("b.exr")}));
    const auto merged = [&](const Words& more) {
        Words all{"merge", cube.path("a.exr"), cube.path("b.exr"),
                  "-o",    cube.path("m.png"), "--exposure",
                  "0"};
        all.insert(all.end(), more.begin(), more.end());
        DisplayFolder::check(run(all));
        return read_png(cube.path("m.png"));
    };
    CHECK(merged({}).values == whole.values);
    PngFile clear = merged({"--background", "transparent", "--png-bits", "16"});
    CHECK(clear.channels == 4);
    CHECK(pixel(clear, above) == Values{0, 0, 0, 0});
    CHECK(nlohmann::json::parse(clear.text["bdpt.settings"])["background"] == "transparent");
    CHECK(merged({"--tone-map", "none"}).values != whole.values);

    DisplayFolder::check(cube.render({"--env", "default", "--part", cube.path("sky.part.exr")}));
    const Outcome refused = run(Words{"merge", cube.path("sky.part.exr"), "-o", cube.path("no.png"),
                                      "--background", "black"});
    CHECK(refused.exit_code == 4);
    CHECK(refused.err.find("--background \"#000000\"") != std::string::npos);
    CHECK_FALSE(cube.has("no.png"));
}

TEST_CASE("options --env-rotation and --env-intensity change the environment")
{
    const DisplayFolder cube;
    const std::string sky = cube.write_sky();
    const auto seen = [&](const Words& more) {
        Words words{"--env", sky};
        words.insert(words.end(), more.begin(), more.end());
        return cube.exr(words).image.pixels[above];
    };
    const auto check_color = [](Rgb actual, Rgb expected) {
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(actual[channel] == Approx(expected[channel]).margin(1e-5));
        }
    };
    // The camera looks along -z.
    check_color(seen({}), {1.0f, 0.0f, 0.0f});
    check_color(seen({"--env-rotation", "90"}), {0.0f, 1.0f, 0.0f});
    check_color(seen({"--env-rotation", "-90"}), Rgb(0.5f));
    check_color(seen({"--env-rotation", "180"}), {0.0f, 0.0f, 1.0f});
    check_color(seen({"--env-rotation", "-180"}), {0.0f, 0.0f, 1.0f});
    check_color(seen({"--env-intensity", "2.5"}), {2.5f, 0.0f, 0.0f});
    check_color(seen({"--env-intensity", "0"}), Rgb(0.0f));
    check_color(seen({"--env-rotation", "90", "--env-intensity", "0.5"}), {0.0f, 0.5f, 0.0f});

    const ExrFile file = cube.exr({"--env", sky, "--env-rotation", "90", "--env-intensity", "3"});
    const auto settings = nlohmann::json::parse(file.text("bdpt.settings"));
    CHECK(settings["environment_rotation_degrees"] == 90.0);
    CHECK(settings["environment_intensity"] == 3.0);

    const Outcome none =
        cube.render({"--env", "none", "--env-rotation", "90", "-o", cube.path("out.exr")});
    CHECK(none.exit_code == 0);
    CHECK(none.err.find("--env-rotation and --env-intensity have no effect") != std::string::npos);
}

TEST_CASE("options --fog fill the scene")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "grey", {.cameras = two_cameras}).string();
    const auto file = [&](const Words& more) {
        Words words{"render", scene,   "--spp", "16",
                    "--size", "32x16", "-o",    (folder / "out.exr").string()};
        words.insert(words.end(), more.begin(), more.end());
        DisplayFolder::check(run(words));
        return read_exr(folder / "out.exr");
    };
    const auto brightness = [](const ExrFile& image) {
        float sum = 0.0f;
        for (const Rgb& pixel : image.image.pixels) {
            sum += pixel.g;
        }
        return sum;
    };
    const float clear = brightness(file({}));
    const float smoke = brightness(file({"--fog", "0.1", "--fog-albedo", "0"}));
    const float mist = brightness(file({"--fog", "0.1"}));
    CHECK(smoke < 0.97f * clear);
    CHECK(mist > smoke);
    CHECK(brightness(file({"--fog", "0"})) == clear);
    const ExrFile all =
        file({"--fog", "0.1,0.2,0.3", "--fog-albedo", "0.5", "--fog-anisotropy", "-0.25"});
    const auto settings = nlohmann::json::parse(all.text("bdpt.settings"))["fog"];
    CHECK(settings["extinction"][2].get<float>() == 0.3f);
    CHECK(settings["albedo"][0] == 0.5);
    CHECK(settings["anisotropy"] == -0.25);
}

TEST_CASE("the default environment is brighter with --env-intensity, too")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "grey", {.cameras = two_cameras}).string();
    const auto pixels = [&](const Words& more) {
        Words words{"render", scene,   "--spp", "4",
                    "--size", "32x16", "-o",    (folder / "out.exr").string()};
        words.insert(words.end(), more.begin(), more.end());
        DisplayFolder::check(run(words));
        return read_exr(folder / "out.exr").image.pixels;
    };
    const std::vector<Rgb> plain = pixels({});
    const std::vector<Rgb> bright = pixels({"--env-intensity", "4"});
    CHECK(bright[above].g == Approx(4.0f * plain[above].g));
    CHECK(bright[center].g == Approx(4.0f * plain[center].g).epsilon(1e-4));
    CHECK(plain[center].g > 0.0f);
}

}  // namespace
}  // namespace bdpt::test::display_test
