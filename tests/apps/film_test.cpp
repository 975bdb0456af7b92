#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::film_test {
namespace {

using Words = std::vector<std::string>;

/// A cube of one nit, 32 x 16 pixels.
class FilmFolder {
public:
    FilmFolder()
        : scene_(
              write_cube(folder_, "cube", {.material = emissive_material, .cameras = two_cameras})
                  .string())
    {}

    Outcome render(const Words& more, const std::string& output = "out.exr") const
    {
        Words words{"render", scene_,  "-o",  (folder_ / output).string(), "--spp", "4", "--size",
                    "32x16",  "--env", "none"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    /// The image that a successful run gives.
    ExrFile rendered(const Words& more) const
    {
        const Outcome outcome = render(more);
        CAPTURE(more, outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_exr(folder_ / "out.exr");
    }
    std::vector<float> channel(const char* name) const
    {
        return read_exr_channel(folder_ / "out.exr", name);
    }
    const ScratchFolder& folder() const { return folder_; }
    const std::string& scene() const { return scene_; }

private:
    ScratchFolder folder_;
    std::string scene_;
};

nlohmann::json settings_of(const ExrFile& file)
{
    return nlohmann::json::parse(file.text("bdpt.settings"));
}

TEST_CASE("option --aov adds layers by their usual names")
{
    const FilmFolder cube;
    const ExrFile plain = cube.rendered({});
    CHECK(plain.header.channels().findChannel("A") == nullptr);
    const ExrFile file =
        cube.rendered({"--aov", "albedo,normal,depth,position,samples,variance,alpha"});
    CHECK(file.image.pixels == plain.image.pixels);
    constexpr std::size_t center = 8 * 32 + 16;
    CHECK(cube.channel("A")[center] == 1.0f);
    CHECK(cube.channel("A")[0] == 0.0f);
    // The camera is at z = 5, the face at z = 1.
    CHECK(cube.channel("depth.Z")[center] == Approx(4.0f));
    CHECK(cube.channel("depth.Z")[0] == std::numeric_limits<float>::infinity());
    CHECK(cube.channel("position.Z")[center] == Approx(1.0f));
    CHECK(cube.channel("normal.Z")[center] == Approx(1.0f));
    CHECK(cube.channel("normal.X")[center] == Approx(0.0f).margin(1e-6));
    CHECK(cube.channel("albedo.G")[center] == 1.0f);
    CHECK(cube.channel("sampleCount.Y")[0] == 4.0f);
    CHECK(cube.channel("variance.R")[0] == 0.0f);
    CHECK(cube.channel("variance.R")[center] < 1.0f);

    CHECK(cube.rendered({"--aov", "depth", "--half"})
              .header.channels()
              .findChannel("depth.Z")
              ->type == Imf::FLOAT);
}

TEST_CASE("option --crop writes the pixels of the whole image, placed in it")
{
    const FilmFolder cube;
    const Words filter{"--filter", "tent:2", "--aov", "depth"};
    const ExrFile whole = cube.rendered(filter);
    const std::vector<float> whole_depth = cube.channel("depth.Z");
    Words words = filter;
    words.insert(words.end(), {"--crop", "10,3,25,16", "--tiled"});
    const ExrFile crop = cube.rendered(words);
    const std::vector<float> depth = cube.channel("depth.Z");
    CHECK(crop.header.dataWindow() == Imath::Box2i({10, 3}, {24, 15}));
    CHECK(crop.header.displayWindow() == Imath::Box2i({0, 0}, {31, 15}));
    CHECK(crop.header.hasTileDescription());
    CHECK(settings_of(crop)["crop"] == nlohmann::json::array({10, 3, 25, 16}));
    REQUIRE(crop.image.width == 15);
    REQUIRE(crop.image.height == 13);
    int different = 0;
    for (int y = 0; y < 13; ++y) {
        for (int x = 0; x < 15; ++x) {
            const auto at = static_cast<std::size_t>((y + 3) * 32 + x + 10);
            different += crop.image.at(x, y) == whole.image.pixels[at] ? 0 : 1;
            different += depth[static_cast<std::size_t>(y * 15 + x)] == whole_depth[at] ? 0 : 1;
        }
    }
    CHECK(different == 0);
    REQUIRE(cube.render({"--crop", "1,2,4,8"}, "out.png").exit_code == 0);
    CHECK(read_png(cube.folder() / "out.png").width == 3);
    CHECK(read_png(cube.folder() / "out.png").height == 6);
}

TEST_CASE("option --filter chooses the pixel filter")
{
    const FilmFolder cube;
    const ExrFile box = cube.rendered({});
    CHECK(settings_of(box)["filter"] == "box");
    CHECK(settings_of(box)["filter_radius"] == 0.5);
    CHECK(cube.rendered({"--filter", "box"}).image.pixels == box.image.pixels);
    for (const char* name : {"tent", "gaussian", "blackman-harris", "box:2"}) {
        CAPTURE(name);
        CHECK_FALSE(cube.rendered({"--filter", name}).image.pixels == box.image.pixels);
    }
    const ExrFile wide = cube.rendered({"--filter", "tent:3.5"});
    CHECK(settings_of(wide)["filter"] == "tent");
    CHECK(settings_of(wide)["filter_radius"] == 3.5);
}

TEST_CASE("option --clamp limits contributions and says what it took")
{
    const FilmFolder cube;
    const Words words{"--integrator", "mis", "--max-depth", "1", "--clamp", "0.25"};
    const Outcome outcome = cube.render(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.find("clamping at 0.25 nit removed 75.00 % of the light") !=
          std::string::npos);
    const ExrFile file = read_exr(cube.folder() / "out.exr");
    CHECK(file.image.at(16, 8) == Rgb(0.25f));
    CHECK(settings_of(file)["clamp"] == 0.25);
    CHECK_FALSE(settings_of(cube.rendered({})).contains("clamp"));
}

TEST_CASE("option --stats writes the numbers of the render")
{
    const FilmFolder cube;
    const std::string stats = (cube.folder() / "stats.json").string();
    cube.rendered({"--stats", stats, "--integrator", "mis", "--max-depth", "1", "--aov", "alpha",
                   "--clamp", "0.5"});
    const auto json = nlohmann::json::parse(read_text(stats));
    constexpr int samples = 32 * 16 * 4;
    CHECK(json["version"] == BDPT_VERSION);
    CHECK(json["file"] == cube.scene());
    CHECK(json["settings"]["integrator"] == "mis");
    CHECK(json["samples"] == 4);
    CHECK(json["rays"]["camera"] == samples);
    CHECK(json["rays"]["light"] == 0);
    CHECK(json["rays"]["shadow"] == 0);
    // Pixels beside the scene need no rays of their own for AOVs.
    const auto aov = json["rays"]["aov"].get<std::int64_t>();
    CHECK(aov > 0);
    CHECK(aov < samples);
    CHECK(json["rays"]["total"] == samples + aov);
    CHECK(json["rays"]["per_second"].get<double>() > 0.0);
    CHECK(json["paths"]["camera"] == samples);
    for (const char* part : {"load", "build", "render", "write"}) {
        CHECK(json["seconds"][part].get<double>() > 0.0);
    }
    CHECK(json["defects"]["invalid"] == 0);
    CHECK(json["defects"]["first_invalid"].is_null());
    CHECK(json["clamp"]["limit"] == 0.5);
    CHECK(json["clamp"]["contributions"].get<int>() > 100);
    CHECK(json["clamp"]["radiance_taken"].size() == 3);
    CHECK(json["stopped_by"].is_null());
    cube.rendered({"--stats", stats});
    CHECK(nlohmann::json::parse(read_text(stats))["clamp"].is_null());
    CHECK(cube.folder().names() ==
          std::set<std::string>{"cube.bin", "cube.gltf", "out.exr", "stats.json"});
}

TEST_CASE("wrong words for the film are refused before anything is rendered")
{
    const FilmFolder cube;
    const auto before = cube.folder().names();
    const auto rejects = [&](const Words& more, int code, const std::string& text) {
        const Outcome outcome = cube.render(more);
        CAPTURE(more, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK(cube.folder().names() == before);
    };
    rejects({"--filter", "sinc"}, 2, "--filter \"sinc\": expected box");
    rejects({"--filter", "tent:0"}, 2, "--filter \"tent:0\"");
    rejects({"--aov", "depth,colour"}, 2, "--aov \"depth,colour\"");
    rejects({"--crop", "0,0,0,5"}, 2, "--crop \"0,0,0,5\"");
    rejects({"--crop", "0,0,33,5"}, 2,
            "crop 0,0,33,5 is empty or outside of the image of 32x16 pixels");
    rejects({"--clamp", "0"}, 2, "--clamp \"0\"");
    rejects({"--clamp", "nan"}, 2, "--clamp");
    const std::string out = (cube.folder() / "out.exr").string();
    rejects({"--stats", out}, 2, "--stats \"" + out + "\": the same file");
    rejects({"--stats", cube.scene()}, 2, "the same file");
    rejects({"--stats", (cube.folder() / "missing/s.json").string()}, 6, "missing/s.json");
    const Outcome png = cube.render({"--aov", "depth"}, "out.png");
    CHECK(png.exit_code == 2);
    CHECK(png.err.find("--aov needs an .exr file") != std::string::npos);
}

}  // namespace
}  // namespace bdpt::test::film_test
