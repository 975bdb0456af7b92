// bdpt render --ground: a shadow catcher, in all that comes out.

#include <algorithm>
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

namespace bdpt::test::ground_test {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t width = 32;
constexpr std::size_t height = 16;

/// A cube under the default sky, seen from the front: its bottom at y = -1, the horizon in the
/// middle.
class GroundFolder {
public:
    GroundFolder() : scene_(write_cube(folder_, "cube", {.cameras = two_cameras}).string()) {}
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    Words words(const Words& more) const
    {
        Words words{"render", scene_, "--size", "32x16", "--integrator", "mis", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    Outcome render(const Words& more) const { return run(words(more)); }
    static void check(const Outcome& outcome, int code = 0)
    {
        CAPTURE(outcome.out, outcome.err);
        REQUIRE(outcome.exit_code == code);
    }
    std::vector<float> channel(const std::string& file, const char* name) const
    {
        return read_exr_channel(path(file), name);
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

const Words catcher{"--background", "transparent", "--ground", "shadow"};

Words joined(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Of the pixels in row `y` that no surface covers.
float darkest(const std::vector<float>& shadow, const std::vector<float>& alpha, std::size_t y)
{
    float most = 0.0f;
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
        most = alpha[i] == shadow[i] ? std::max(most, shadow[i]) : most;
    }
    return most;
}

/// Straight alpha of a file with four channels of eight bits.
std::vector<std::uint16_t> alpha_of(const PngFile& file)
{
    std::vector<std::uint16_t> alpha;
    for (std::size_t i = 3; i < file.values.size(); i += 4) {
        alpha.push_back(file.values[i]);
    }
    return alpha;
}

TEST_CASE("option --ground shadow adds a shadow to alpha, and leaves colours as they are")
{
    const GroundFolder folder;
    const Words spp{"--spp", "16", "--exposure", "0"};
    GroundFolder::check(folder.render(joined(
        joined(catcher, spp), {"-o", folder.path("with.exr"), "-o", folder.path("with.png")})));
    GroundFolder::check(
        folder.render(joined(spp, {"--background", "transparent", "--ground", "none", "-o",
                                   folder.path("without.exr"), "-o", folder.path("without.png")})));
    const std::vector<float> shadow = folder.channel("with.exr", "shadow.A");
    const std::vector<float> alpha = folder.channel("with.exr", "A");
    const std::vector<float> coverage = folder.channel("without.exr", "A");
    const ExrFile with = read_exr(folder.path("with.exr"));
    CHECK(with.image.pixels == read_exr(folder.path("without.exr")).image.pixels);
    PngFile png = read_png(folder.path("with.png"));
    REQUIRE(png.channels == 4);
    const std::vector<std::uint16_t> codes = alpha_of(png);
    REQUIRE(codes.size() == alpha.size());
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        REQUIRE(alpha[i] == Approx(coverage[i] + shadow[i]).margin(1e-6));
        REQUIRE(codes[i] == static_cast<std::uint16_t>(255.0f * alpha[i] + 0.5f));
        REQUIRE((i / width >= height / 2 || shadow[i] == 0.0f));  // above the horizon
        if (coverage[i] == 0.0f) {
            REQUIRE(png.values[4 * i] == 0);  // black
        }
    }
    CHECK(darkest(shadow, alpha, 11) > 0.2f);  // beside the bottom of the cube
    CHECK(darkest(shadow, alpha, 15) < darkest(shadow, alpha, 11));
    const auto settings = nlohmann::json::parse(png.text["bdpt.settings"]);
    CHECK(settings["ground"] == "shadow");
    CHECK(settings["ground_height"] == -1.0);
    CHECK_FALSE(nlohmann::json::parse(read_png(folder.path("without.png")).text["bdpt.settings"])
                    .contains("ground"));
}

TEST_CASE("a colour of --background is darkened by the shadow on the ground")
{
    const GroundFolder folder;
    GroundFolder::check(folder.render({"--background", "#ffffff", "--ground", "shadow", "-o",
                                       folder.path("white.png"), "-o", folder.path("white.exr")}));
    const PngFile png = read_png(folder.path("white.png"));
    REQUIRE(png.channels == 3);
    const std::vector<float> shadow = folder.channel("white.exr", "shadow.A");
    const std::vector<float> alpha = folder.channel("white.exr", "A");
    int dark = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        if (alpha[i] == shadow[i]) {
            const double light = 1.0 - static_cast<double>(alpha[i]);
            const double code =
                light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
            REQUIRE(static_cast<double>(png.values[3 * i]) == Approx(255.0 * code).margin(0.51));
            dark += png.values[3 * i] < 245 ? 1 : 0;
        }
    }
    CHECK(dark > 10);
}

TEST_CASE("without --background the visible environment is darkened by the shadow on the ground")
{
    const GroundFolder folder;
    const Words more{"--exposure", "0", "--tone-map", "none"};
    const auto write = [&](const Words& how, const std::string& name) {
        GroundFolder::check(
            folder.render(joined(joined(more, how), {"-o", folder.path(name + ".exr"), "-o",
                                                     folder.path(name + ".png")})));
    };
    write({"--ground", "none"}, "plain");
    write({"--ground", "shadow"}, "shaded");
    const std::vector<float> shadow = folder.channel("shaded.exr", "shadow.A");
    const std::vector<Rgb> plain = read_exr(folder.path("plain.exr")).image.pixels;
    const std::vector<Rgb> shaded = read_exr(folder.path("shaded.exr")).image.pixels;
    REQUIRE(shadow.size() == plain.size());
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        REQUIRE(shaded[i].g == Approx(plain[i].g * (1.0f - shadow[i])).margin(1e-6));
    }
    CHECK(*std::max_element(shadow.begin(), shadow.end()) > 0.2f);
    // What is made of the .exr, or of parts, is the same.
    const std::vector<std::uint16_t> shown = read_png(folder.path("shaded.png")).values;
    CHECK(shown != read_png(folder.path("plain.png")).values);
    GroundFolder::check(run(
        joined({"develop", folder.path("shaded.exr"), "-o", folder.path("developed.png")}, more)));
    CHECK(read_png(folder.path("developed.png")).values == shown);
    GroundFolder::check(
        folder.render({"--ground", "shadow", "--part", folder.path("all.part.exr")}));
    GroundFolder::check(
        run(joined({"merge", folder.path("all.part.exr"), "-o", folder.path("merged.png")}, more)));
    CHECK(read_png(folder.path("merged.png")).values == shown);
}

TEST_CASE("a shadow that nothing shows is told")
{
    const GroundFolder folder;
    Words words = folder.words(
        {"--ground", "shadow", "--env", "none", "--spp", "1", "-o", folder.path("black.png")});
    std::erase(words, "--quiet");
    const Outcome outcome = run(words);
    GroundFolder::check(outcome);
    CHECK(outcome.err.find("the shadow on the ground is not visible") != std::string::npos);
}

TEST_CASE("option --ground-height moves the ground")
{
    const GroundFolder folder;
    const auto mean = [&](const Words& more) {
        GroundFolder::check(
            folder.render(joined(joined(catcher, more), {"-o", folder.path("out.exr")})));
        double sum = 0.0;
        for (const float opacity : folder.channel("out.exr", "shadow.A")) {
            sum += static_cast<double>(opacity);
        }
        return sum;
    };
    const double lowest = mean({});
    CHECK(mean({"--ground-height", "-1"}) == lowest);
    CHECK(mean({"--ground-height=-1.5"}) > lowest);  // the darkest of it is seen then
    CHECK(mean({"--ground-height", "0.5"}) == 0.0);  // above the camera
    // With whatever else can be said of files.
    CHECK(mean({"--half", "--tiled", "--crop", "0,0,32,16"}) == Approx(lowest).epsilon(1e-3));
    CHECK(mean({"--half", "--aov", "depth,alpha"}) == Approx(lowest).epsilon(1e-3));
}

TEST_CASE("words about a ground that make no sense are refused by name")
{
    const GroundFolder folder;
    const auto refused = [&](const Words& more, const std::string& option,
                             const std::string& value) {
        const Outcome outcome = folder.render(joined(more, {"-o", folder.path("no.png")}));
        CAPTURE(more, outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(option) != std::string::npos);
        CHECK(outcome.err.find(value) != std::string::npos);
        CHECK_FALSE(folder.has("no.png"));
    };
    const Words clear{"--background", "transparent"};
    refused(joined(clear, {"--ground", "foo"}), "--ground", "foo");
    refused(joined(catcher, {"--ground-height", "nan"}), "--ground-height", "nan");
    refused(joined(catcher, {"--ground-height", "inf"}), "--ground-height", "inf");
    refused(joined(catcher, {"--ground-height", "1e30"}), "--ground-height", "1e30");
    refused(joined(catcher, {"--ground-height", "low"}), "--ground-height", "low");
    refused(joined(clear, {"--ground-height", "2"}), "--ground-height", "--ground shadow");
    refused(joined(clear, {"--ground", "none", "--ground-height", "2"}), "--ground-height",
            "--ground shadow");
}

TEST_CASE("parts of a shadow on the ground are merged to the one of a render")
{
    const GroundFolder folder;
    const auto part = [&](const char* samples, const char* name, const Words& more = {}) {
        GroundFolder::check(
            folder.render(joined(joined(catcher, more), {"--spp", "8", "--samples", samples,
                                                         "--part", folder.path(name)})));
    };
    part("0:6", "a.part.exr");
    part("6:8", "b.part.exr");
    part("6:8", "c.part.exr", {"--ground-height", "-2"});
    GroundFolder::check(folder.render(joined(
        catcher, {"--spp", "8", "-o", folder.path("whole.exr"), "-o", folder.path("whole.png")})));
    const auto merge = [&](const char* other) {
        return run({"merge", folder.path("a.part.exr"), folder.path(other), "-o",
                    folder.path("m.exr"), "-o", folder.path("m.png"), "--quiet"});
    };
    const Outcome refused = merge("c.part.exr");
    CHECK(refused.exit_code == 4);
    CHECK(refused.err.find("ground_height (-2, not none)") != std::string::npos);
    CHECK_FALSE(folder.has("m.png"));
    GroundFolder::check(merge("b.part.exr"));
    for (const char* name : {"A", "shadow.A", "R"}) {
        CHECK(folder.channel("m.exr", name) == folder.channel("whole.exr", name));
    }
    CHECK(read_png(folder.path("m.png")).values == read_png(folder.path("whole.png")).values);
}

TEST_CASE("plans and turntables have shadows on the ground, too")
{
    const GroundFolder folder;
    const Words more = joined(catcher, {"--spp", "4", "-o", folder.path("planned.png")});
    Words words = folder.words(more);
    words[0] = "plan";
    GroundFolder::check(
        run(joined(words, {"--parts", "2", "--for", "make", "-d", folder.path("job")})));
    const std::string plan = folder.path("job/plan.json");
    for (const char* task : {"0", "1"}) {
        GroundFolder::check(run({"render", "--plan", plan, "--task", task, "--quiet"}));
    }
    GroundFolder::check(run({"merge", "--plan", plan, "--quiet"}));
    GroundFolder::check(
        folder.render(joined(catcher, {"--spp", "4", "-o", folder.path("alone.png")})));
    const PngFile alone = read_png(folder.path("alone.png"));
    CHECK(read_png(folder.path("planned.png")).values == alone.values);

    GroundFolder::check(folder.render(joined(
        catcher, {"--spp", "4", "--orbit", "4", "--same-noise", "-o", folder.path("turn.#.png")})));
    CHECK(read_png(folder.path("turn.1.png")).values == alone.values);
    const std::vector<std::uint16_t> turned = alpha_of(read_png(folder.path("turn.2.png")));
    CHECK(*std::max_element(turned.end() - 5 * width, turned.end()) > 50);
}

TEST_CASE("with --denoise the shadow on the ground is denoised, and the noisy one a layer")
{
    const GroundFolder folder;
    const Words fake{"--denoiser-library", BDPT_FAKE_OIDN};
    const auto write = [&](const char* name, const Words& more) {
        GroundFolder::check(
            folder.render(joined(joined(catcher, more), {"-o", folder.path(name)})));
    };
    write("noisy.exr", {});
    write("clean.exr", joined(fake, {"--denoise"}));
    write("both.exr", joined(fake, {"--denoise=layer"}));
    write("clean.png", joined(fake, {"--denoise", "--exposure", "0"}));
    const std::vector<float> noisy = folder.channel("noisy.exr", "shadow.A");
    const std::vector<float> alpha = folder.channel("noisy.exr", "A");
    CHECK(folder.channel("clean.exr", "noisyShadow.A") == noisy);
    CHECK(folder.channel("both.exr", "shadow.A") == noisy);
    CHECK(folder.channel("both.exr", "A") == alpha);
    const std::vector<float> clean = folder.channel("clean.exr", "shadow.A");
    CHECK(folder.channel("both.exr", "denoisedShadow.A") == clean);
    const std::vector<float> clean_alpha = folder.channel("clean.exr", "A");
    const std::vector<std::uint16_t> codes = alpha_of(read_png(folder.path("clean.png")));
    for (std::size_t i = 0; i < clean.size(); ++i) {
        const float covered = alpha[i] - noisy[i];
        // That library doubles opacities where the ground is seen, and what is there is at most 1.
        const float expected = std::min(2.0f * noisy[i], 1.0f - covered);
        REQUIRE(clean[i] == Approx(expected).margin(1e-6));
        REQUIRE((clean[i] >= 0.0f && clean[i] <= Approx(1.0f - covered).margin(1e-6)));
        REQUIRE(clean_alpha[i] == Approx(covered + clean[i]).margin(1e-6));
        REQUIRE(codes[i] == static_cast<std::uint16_t>(255.0f * clean_alpha[i] + 0.5f));
    }
}

TEST_CASE("pictures of an object without light show its shadow, files of light do not")
{
    const GroundFolder folder;
    const auto render = [&](const std::string& name, const Words& more) {
        const Words words{"--spp",
                          "16",
                          "--exposure",
                          "0",
                          "--denoise=false",
                          "-o",
                          folder.path(name + ".png"),
                          "-o",
                          folder.path(name + ".exr")};
        GroundFolder::check(folder.render(joined(words, more)));
        return read_png(folder.path(name + ".png"));
    };
    const PngFile plain = render("plain", {"--ground", "none"});
    const PngFile shadowed = render("shadowed", {});
    std::size_t darker = 0;
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        CHECK(shadowed.values[i] <= plain.values[i]);
        darker += shadowed.values[i] < plain.values[i] ? 1U : 0U;
    }
    CHECK(darker > 20);
    for (const char* channel : {"R", "G", "B"}) {
        CHECK(folder.channel("shadowed.exr", channel) == folder.channel("plain.exr", channel));
    }
    CHECK_THROWS(folder.channel("shadowed.exr", "shadow.A"));
    // Only that light has the shadow, and only the visible environment.
    const Words sky{"--env", "default"};
    CHECK(render("sky", sky).values ==
          render("sky_none", joined(sky, {"--ground", "none"})).values);
    const Words white{"--background", "white"};
    CHECK(render("white", white).values ==
          render("white_none", joined(white, {"--ground", "none"})).values);
    // What --ground shadow makes is in all files.
    CHECK(render("asked", {"--ground", "shadow"}).values == shadowed.values);
    CHECK(folder.channel("asked.exr", "G") != folder.channel("plain.exr", "G"));
}

}  // namespace
}  // namespace bdpt::test::ground_test
