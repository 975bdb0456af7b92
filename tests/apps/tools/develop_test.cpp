// bdpt develop: pictures of an .exr file are those that bdpt render writes with the same options.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::develop_test {
namespace {

/// Returns the chunks of a WebP file that hold its image: those between its header and Exif.
std::string coded_image(const std::filesystem::path& file)
{
    constexpr std::size_t header = 30;
    const std::string bytes = read_text(file);
    const std::size_t end = bytes.rfind("EXIF");
    REQUIRE(end != std::string::npos);
    return bytes.substr(header, end - header);
}

using Words = std::vector<std::string>;

Words joined(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class Darkroom {
public:
    Darkroom() : scene_(write_cube(folder_, "cube", {.cameras = two_cameras}).string()) {}
    /// With a cube of that material.
    explicit Darkroom(const char* material)
        : scene_(
              write_cube(folder_, "cube", {.material = material, .cameras = two_cameras}).string())
    {}

    [[nodiscard]] std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }
    void render(const Words& words) const
    {
        succeed(joined({"render", scene_, "--size", "32x16", "--spp", "4", "--integrator", "mis"},
                       words));
    }
    void succeed(const Words& words) const
    {
        const Outcome outcome = run(Launch{.arguments = words, .folder = folder_ / ""});
        CAPTURE(words, outcome.out, outcome.err);
        REQUIRE(outcome.exit_code == 0);
    }
    /// What `develop` answers.
    [[nodiscard]] std::string refused(const Words& words, int code) const
    {
        const auto before = folder_.names();
        const Outcome outcome =
            run(Launch{.arguments = joined({"develop"}, words), .folder = folder_ / ""});
        CAPTURE(words, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(folder_.names() == before);
        return outcome.err;
    }
    /// Renders with `rendering`, and with `look` into a picture as well; then develops that with
    /// `look` from the .exr file. Both pictures have to be equal to the bit.
    void check_equal(const Words& rendering, const Words& look) const
    {
        // A shadow that only pictures have is not in the file.
        const bool has_ground =
            std::find(rendering.begin(), rendering.end(), "--ground") != rendering.end();
        render(
            joined(joined(joined(rendering, look), {"-o", "r.png", "-o", "r.webp", "-o", "r.exr"}),
                   has_ground ? Words{} : Words{"--ground", "none"}));
        render(joined(rendering, {"-o", "image.exr"}));
        succeed(joined({"develop", "image.exr", "-o", "d.png", "-o", "d.webp"}, look));
        CAPTURE(rendering, look);
        const PngFile rendered = read_png(path("r.png"));
        const PngFile developed = read_png(path("d.png"));
        CHECK(rendered.width == developed.width);
        CHECK(rendered.height == developed.height);
        CHECK(rendered.channels == developed.channels);
        CHECK(rendered.bits == developed.bits);
        CHECK(rendered.values == developed.values);
        CHECK(coded_image(path("r.webp")) == coded_image(path("d.webp")));
        CHECK(rendered.text.at("bdpt.exposure") == developed.text.at("bdpt.exposure"));
        CHECK(developed.text.at("bdpt.scene") == "cube.gltf");
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

const Words denoising{"--denoise", "--denoiser-library", BDPT_FAKE_OIDN};

TEST_CASE("pictures of an image are those that its render would have written", "[develop]")
{
    const Darkroom room;
    room.check_equal({}, {});
    room.check_equal({}, {"--exposure", "1.5", "--tone-map", "agx", "--png-bits", "16"});
    room.check_equal({"--crop", "4,2,20,15"}, {"--tone-map", "pbr-neutral"});
    room.check_equal({"--aov", "alpha,albedo"}, {});
    // A background that the .exr file was rendered with, and another one.
    room.check_equal({"--background", "transparent"}, {});
    room.check_equal({"--background", "transparent"}, {"--background", "white"});
    room.check_equal({"--background", "#204060", "--ground", "shadow"}, {});
    room.check_equal({"--background", "black", "--ground", "shadow"},
                     {"--background", "transparent"});
}

TEST_CASE("denoised pictures of an image are those that its render would have written", "[develop]")
{
    const bool blends = GENERATE(false, true);
    const Darkroom room = blends ? Darkroom(R"({"pbrMetallicRoughness": {"metallicFactor": 0,
                                       "baseColorFactor": [0.5, 0.5, 0.5, 0.5]},
                                       "alphaMode": "BLEND"})")
                                 : Darkroom();
    const Words layers{"--aov", "albedo,normal,opacity"};
    const Words backdrop{"--background", "transparent", "--ground", "shadow"};
    room.check_equal(layers, denoising);
    room.check_equal(joined(layers, backdrop), denoising);
    // The file has the denoised image already, as its image or as a layer.
    room.check_equal(denoising, {});
    room.check_equal(joined(denoising, backdrop), {});
    const auto same = [&](const Words& words, const Words& other_words) {
        room.succeed(joined(joined({"develop"}, words), {"-o", "a.png"}));
        room.succeed(joined(joined({"develop"}, other_words), {"-o", "b.png"}));
        CAPTURE(words, other_words);
        CHECK(read_png(room.path("a.png")).values == read_png(room.path("b.png")).values);
    };
    for (const Words& more : {Words{}, backdrop}) {
        const Words as_layer{"--denoise=layer", "--denoiser-library", BDPT_FAKE_OIDN};
        room.render(joined(joined(denoising, more), {"-o", "image.exr"}));
        room.render(joined(joined(as_layer, more), {"-o", "layer.exr"}));
        same(joined({"image.exr"}, denoising), {"image.exr"});
        same(joined({"layer.exr"}, denoising), {"image.exr"});
    }
}

TEST_CASE("a photograph lies behind what is rendered, in all of its pixels", "[develop]")
{
    const Darkroom room;
    // A picture of something else, of the frame's size; it is stored without loss.
    room.render({"-o", "photo.png", "--camera", "1", "--exposure", "0", "--env", "none"});
    const PngFile photo = read_png(room.path("photo.png"));
    const Words look{"--background", "photo.png", "--ground", "shadow"};
    room.render(joined(look, {"-o", "a.png", "-o", "a.exr"}));
    const PngFile shown = read_png(room.path("a.png"));
    const std::vector<float> alpha = read_exr_channel(room.path("a.exr"), "A");
    REQUIRE(shown.channels == 3);
    REQUIRE(photo.rgb.size() == shown.rgb.size());
    int open = 0;
    int covered = 0;
    for (std::size_t i = 0; i < shown.rgb.size(); ++i) {
        if (alpha[i / 3] == 0.0f) {
            REQUIRE(shown.rgb[i] == photo.rgb[i]);
            ++open;
        } else {
            covered += shown.rgb[i] != photo.rgb[i] ? 1 : 0;
        }
    }
    CHECK(open > 100);
    CHECK(covered > 100);
    room.check_equal(look, {});
    room.check_equal(joined(look, {"--crop", "4,2,20,15"}), {});
    room.check_equal({"--background", "transparent"}, {"--background", "photo.png"});
    // A part of the frame has that part of the photograph.
    room.render(joined(look, {"--crop", "4,2,20,15", "-o", "part.png", "--exposure", "0"}));
    room.render(joined(look, {"-o", "whole.png", "--exposure", "0"}));
    const PngFile part = read_png(room.path("part.png"));
    const PngFile whole = read_png(room.path("whole.png"));
    REQUIRE(part.width == 16);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < 3 * part.width; ++x) {
            const auto there = static_cast<std::size_t>((y + 2) * 3 * whole.width + x + 12);
            const auto here = static_cast<std::size_t>(y * 3 * part.width + x);
            if (alpha[there / 3] == 0.0f) {
                REQUIRE(part.rgb[here] == photo.rgb[there]);
            }
        }
    }
}

TEST_CASE("a photograph lies behind every image of a command", "[develop]")
{
    const Darkroom room;
    room.render({"-o", "photo.png", "--camera", "1", "--exposure", "0", "--env", "none"});
    const std::vector<std::uint8_t> photo = read_png(room.path("photo.png")).rgb;
    const Words behind{"--background", "photo.png", "--exposure", "0"};
    room.render(joined(behind, {"--orbit", "2", "-o", "o.#.png", "-o", "o.#.exr"}));
    room.render(joined(behind, {"--cameras", "all", "-o", "c.{camera}.png"}));
    std::filesystem::copy_file(room.path("cube.gltf"), room.path("other.gltf"));
    room.render(joined(behind, {"other.gltf", "-o", "s.{name}.png"}));
    for (const char* name : {"c.front.png", "c.side.png", "s.cube.png", "s.other.png"}) {
        CAPTURE(name);
        const std::vector<std::uint8_t> shown = read_png(room.path(name)).rgb;
        CHECK(std::equal(shown.begin(), shown.begin() + 3, photo.begin()));  // in a corner
    }
    const std::vector<std::uint8_t> first = read_png(room.path("o.1.png")).rgb;
    const std::vector<std::uint8_t> second = read_png(room.path("o.2.png")).rgb;
    CHECK(first != second);
    for (const char* number : {"1", "2"}) {
        const auto name = std::string("o.") + number;
        const std::vector<std::uint8_t> shown = read_png(room.path(name + ".png")).rgb;
        const std::vector<float> alpha = read_exr_channel(room.path(name + ".exr"), "A");
        int open = 0;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            if (alpha[i / 3] == 0.0f) {
                REQUIRE(shown[i] == photo[i]);
                ++open;
            }
        }
        CHECK(open > 100);
    }
}

TEST_CASE("a photograph is found beside the image that names it", "[develop]")
{
    const Darkroom room;
    room.render({"-o", "photo.png", "--camera", "1", "--exposure", "0", "--env", "none"});
    room.render(
        {"-o", "a.png", "-o", "a.exr", "--part", "a.part.exr", "--background", "photo.png"});
    const std::filesystem::path folder = room.path("moved");
    std::filesystem::create_directory(folder);
    for (const char* name : {"photo.png", "a.exr", "a.part.exr"}) {
        std::filesystem::rename(room.path(name), folder / name);
    }
    room.succeed({"develop", "moved/a.exr", "-o", "b.png"});
    CHECK(read_png(room.path("a.png")).values == read_png(room.path("b.png")).values);
    room.succeed({"merge", "moved/a.part.exr", "-o", "c.png"});
    CHECK(read_png(room.path("a.png")).values == read_png(room.path("c.png")).values);
    std::filesystem::remove(folder / "photo.png");
    CHECK(room.refused({"moved/a.exr", "-o", "d.png"}, 3).find("photo.png: no such file") !=
          std::string::npos);
}

TEST_CASE("a photograph of other proportions fills the frame", "[develop]")
{
    const Darkroom room;
    // Left and right of the middle half it is cut off; 64 x 32 becomes 16 x 16.
    room.succeed({"render", "cube.gltf", "--size", "64x32", "--spp", "4", "--env", "none",
                  "--exposure", "0", "-o", "wide.png"});
    room.succeed({"render", "cube.gltf", "--size", "16x16", "--spp", "1", "-o", "a.png", "-o",
                  "a.exr", "--background", "wide.png"});
    const PngFile wide = read_png(room.path("wide.png"));
    const PngFile shown = read_png(room.path("a.png"));
    const std::vector<float> alpha = read_exr_channel(room.path("a.exr"), "A");
    int compared = 0;
    for (std::size_t y = 0; y < 16; ++y) {
        for (std::size_t x = 0; x < 16; ++x) {
            if (alpha[16 * y + x] > 0.0f) {
                continue;
            }
            // A tent over 4 x 4 pixels lies between the darkest and the brightest of them.
            int least = 255;
            int most = 0;
            for (std::size_t i = 0; i < 16; ++i) {
                const long row = std::clamp(static_cast<long>(2 * y + i / 4) - 1, 0L, 31L);
                const auto column = static_cast<long>(2 * x + i % 4) - 1 + 16;
                const int code = wide.rgb[static_cast<std::size_t>(3 * (64 * row + column))];
                least = std::min(least, code);
                most = std::max(most, code);
            }
            CHECK(shown.rgb[3 * (16 * y + x)] >= least);
            CHECK(shown.rgb[3 * (16 * y + x)] <= most);
            ++compared;
        }
    }
    CHECK(compared > 20);
}

TEST_CASE("a picture without a name is that of the image", "[develop]")
{
    const Darkroom room;
    room.render({"-o", "image.exr"});
    room.succeed({"develop", "image.exr"});
    CHECK(read_png(room.path("image.png")).width == 32);
    write_text(room.path("image.png"), "of somebody else");
    CHECK(room.refused({"image.exr"}, 6).find("was not written by bdpt") != std::string::npos);
}

TEST_CASE("what cannot be developed is refused", "[develop]")
{
    const Darkroom room;
    room.render({"-o", "image.exr"});
    room.render({"-o", "clear.exr", "--background", "transparent"});
    write_text(room.path("text.exr"), "no image");
    const std::string whole = read_text(room.path("image.exr"));
    write_text(room.path("cut.exr"), whole.substr(0, whole.size() / 2));
    const auto refused = [&](const Words& words, int code, const std::string& message) {
        const std::string said = room.refused(words, code);
        CAPTURE(said);
        CHECK(said.find(message) != std::string::npos);
    };
    refused({"image.exr", "-o", "a.png", "--background", "white"}, 4,
            "--background \"#ffffff\": image.exr contains the environment");
    refused({"image.exr", "-o", "a.exr"}, 2, "a.exr: develop writes display images");
    refused({"image.exr", "-o", "a.png", "-o", "a.png"}, 2, "named twice");
    refused({"clear.exr", "-o", "a.jpg"}, 2, "a.jpg: JPEG has no alpha");
    refused({"image.exr", "-o", "a.png", "--denoise=layer"}, 2, "--denoise \"layer\"");
    refused({"none.exr", "-o", "a.png"}, 3, "none.exr: no such file");
    refused({"text.exr", "-o", "a.png"}, 5, "text.exr: neither OpenEXR");
    refused({"cut.exr", "-o", "a.png"}, 4, "cut.exr: OpenEXR");
    refused({"clear.exr", "-o", "a.png", "--background", "none.png"}, 3, "none.png: no such file");
    refused({"clear.exr", "-o", "a.png", "--background", "text.exr"}, 5, "text.exr: neither");
    refused({"clear.exr", "-o", "a.png", "--background", "a.png"}, 2, "a.png");
    refused({"clear.exr", "-o", "a.png", "--background", "whitish"}, 2, "--background \"whitish\"");
    refused({}, 2, "file is required");
}

}  // namespace
}  // namespace bdpt::test::develop_test
