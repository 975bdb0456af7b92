// Denoised images of bdpt render and bdpt merge, by a library that counts
// (tests/support/fake_oidn.cpp): images become 2 * image + albedo + 1 + normal + 2.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::denoise_test {
namespace {

using Words = std::vector<std::string>;
using ExrChannels = std::map<std::string, std::vector<float>>;

ExrChannels read_channels(const std::string& file)
{
    ExrChannels result;
    const Imf::InputFile exr(file.c_str());
    const Imf::ChannelList& channels = exr.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        result[channel.name()] = read_exr_channel(file, channel.name());
    }
    return result;
}

class DenoiseFolder {
public:
    DenoiseFolder() : scene_(write_cube(folder_, "cube", {.cameras = two_cameras}).string()) {}
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    Outcome render(const Words& more,
                   const std::map<std::string, std::string>& environment = {}) const
    {
        Words words{"render", scene_, "--size", "8x4", "--spp", "4", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return run({.arguments = words, .environment = environment});
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

/// Is the image in `clean` what the library makes of the one in `noisy`?
void check_denoised(const ExrChannels& clean, const std::string& prefix, const ExrChannels& noisy)
{
    for (const auto& [color, axis] :
         {std::pair("R", "X"), std::pair("G", "Y"), std::pair("B", "Z")}) {
        const auto& image = noisy.at(color);
        const auto& albedo = clean.at(std::string("albedo.") + color);
        const auto& normal = clean.at(std::string("normal.") + axis);
        const auto& result = clean.at(prefix + color);
        REQUIRE(result.size() == image.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            CHECK(result[i] == Approx(2.0f * image[i] + albedo[i] + normal[i] + 3.0f));
        }
    }
}

}  // namespace

TEST_CASE("with --denoise the noisy image is a layer")
{
    const DenoiseFolder folder;
    CHECK(folder.render({"-o", folder.path("plain.exr")}).exit_code == 0);
    const ExrChannels plain = read_channels(folder.path("plain.exr"));
    CHECK(plain.count("noisy.R") == 0);
    const Outcome outcome = folder.render(
        {"-o", folder.path("clean.exr"), "--denoise", "--denoiser-library", BDPT_FAKE_OIDN});
    REQUIRE(outcome.exit_code == 0);
    const ExrChannels clean = read_channels(folder.path("clean.exr"));
    CHECK(clean.at("noisy.G") == plain.at("G"));
    check_denoised(clean, "", plain);
}

TEST_CASE("before a backdrop colours of surfaces are denoised, and edges stay")
{
    const DenoiseFolder folder;
    REQUIRE(folder
                .render({"-o", folder.path("clean.exr"), "--background", "transparent", "--spp",
                         "16", "--denoise", "--denoiser-library", BDPT_FAKE_OIDN})
                .exit_code == 0);
    const ExrChannels clean = read_channels(folder.path("clean.exr"));
    const std::vector<float>& coverage = clean.at("A");
    int partial = 0;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        // What that library adds is added to surfaces, not to what is beside them.
        const float expected = 2.0f * clean.at("noisy.G")[i] + clean.at("albedo.G")[i] +
                               clean.at("normal.Y")[i] + 3.0f * coverage[i];
        CHECK(clean.at("G")[i] == Approx(expected).margin(1e-6));
        partial += coverage[i] > 0.0f && coverage[i] < 1.0f ? 1 : 0;
    }
    CHECK(std::count(coverage.begin(), coverage.end(), 0.0f) > 0);
    CHECK(partial > 0);
}

TEST_CASE("before a backdrop denoised images have no noise in the alpha of surfaces that blend")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "veil",
                   {.material = R"({"pbrMetallicRoughness": {"metallicFactor": 0,
                        "baseColorFactor": [0.5, 0.5, 0.5, 0.5]}, "alphaMode": "BLEND"})",
                    .cameras = two_cameras})
            .string();
    const std::string file = (folder / "veil.exr").string();
    const Words words{"render",      scene,          "-o",          file,
                      "--size",      "16x8",         "--spp",       "4",
                      "--quiet",     "--background", "transparent", "--denoiser-library",
                      BDPT_FAKE_OIDN};
    const bool as_layer = GENERATE(false, true);
    Words asked = words;
    asked.push_back(as_layer ? "--denoise=layer" : "--denoise");
    REQUIRE(run(asked).exit_code == 0);
    const ExrChannels exr = read_channels(file);
    const std::vector<float>& clean = exr.at(as_layer ? "denoisedAlpha.A" : "A");
    const std::vector<float>& noisy = exr.at(as_layer ? "A" : "noisyAlpha.A");
    CHECK(clean == exr.at("opacity.A"));
    // Front and back of the cube, each of which takes half of the light; the middle has no edges.
    const std::size_t middle = 4 * 16 + 8;
    CHECK(clean[middle] == Approx(0.75f));
    CHECK(clean.front() == 0.0f);
    double chance = 0.0;
    for (std::size_t i = 0; i < clean.size(); ++i) {
        chance += std::abs(static_cast<double>(clean[i] - noisy[i]));
        CHECK((clean[i] > 0.0f || noisy[i] == 0.0f));
    }
    CHECK(chance > 0.5);
}

TEST_CASE("pictures are denoised by default, images of light never")
{
    const DenoiseFolder folder;
    const Words look =
        GENERATE(Words{}, Words{"--background", "transparent"},
                 Words{"--aov", "albedo", "--background", "#204060", "--ground", "shadow"});
    const auto render = [&](const std::string& name, const Words& more, const char* library) {
        Words words{"-o", folder.path(name + ".exr"), "-o", folder.path(name + ".png"),
                    "-o", folder.path(name + ".hdr")};
        words.insert(words.end(), look.begin(), look.end());
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = folder.render(words, {{"BDPT_DENOISER", library}});
        REQUIRE(outcome.exit_code == 0);
    };
    render("auto", {}, BDPT_FAKE_OIDN);
    const std::string exposure = read_png(folder.path("auto.png")).text.at("bdpt.exposure");
    render("asked", {"--denoise", "--exposure", exposure}, BDPT_FAKE_OIDN);
    render("off", {"--denoise=false"}, BDPT_FAKE_OIDN);
    render("absent", {}, "");
    const auto picture = [&](const char* name) { return read_png(folder.path(name)); };
    const PngFile denoised = picture("auto.png");
    CHECK(denoised.values == picture("asked.png").values);
    CHECK(denoised.text.at("bdpt.exposure") == picture("off.png").text.at("bdpt.exposure"));
    CHECK(denoised.values != picture("off.png").values);
    CHECK(denoised.text.at("bdpt.denoiser") == "Open Image Denoise 2.71.8");
    // .exr files have neither the layers that guide the denoiser nor a word about it.
    const ExrChannels raw = read_channels(folder.path("off.exr"));
    CHECK(raw.count("normal.X") == 0);
    CHECK(read_channels(folder.path("auto.exr")) == raw);
    CHECK(read_text(folder.path("auto.exr")).find("denois") == std::string::npos);
    CHECK(read_text(folder.path("auto.exr")).size() == read_text(folder.path("off.exr")).size());
    CHECK(read_text(folder.path("auto.hdr")) != read_text(folder.path("asked.hdr")));
    // Without the library the picture is that of --denoise=false.
    CHECK(picture("absent.png").values == picture("off.png").values);
    CHECK(picture("absent.png").text.count("bdpt.denoiser") == 0);
    CHECK(read_channels(folder.path("absent.exr")) == raw);
}

TEST_CASE("a large denoised picture alone has fewer samples unless their number is asked for")
{
    const DenoiseFolder folder;
    const std::string png = folder.path("a.png");
    const auto samples = [&](const char* size, const Words& more, const char* library) {
        Words words{"render",       folder.path("cube.gltf"),
                    "-o",           png,
                    "--integrator", "pt",
                    "--size",       size,
                    "--crop",       "0,0,8,8",
                    "--json",       "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome =
            run({.arguments = words, .environment = {{"BDPT_DENOISER", library}}});
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return nlohmann::json::parse(outcome.out)["samples"].get<int>();
    };
    CHECK(samples("1920x1080", {}, BDPT_FAKE_OIDN) == 8);
    CHECK(samples("1280x720", {}, BDPT_FAKE_OIDN) == 8);
    CHECK(samples("800x600", {}, BDPT_FAKE_OIDN) == 16);
    CHECK(samples("640x360", {"--denoise", "-o", folder.path("a.webp")}, BDPT_FAKE_OIDN) == 32);
    CHECK(samples("480x270", {}, BDPT_FAKE_OIDN) == 64);
    const auto large = [&](const Words& more) { return samples("1280x720", more, BDPT_FAKE_OIDN); };
    CHECK(samples("1280x720", {}, "") == 64);
    CHECK(large({"--denoise=false"}) == 64);
    CHECK(large({"-o", folder.path("a.exr")}) == 64);
    CHECK(large({"--spp", "64"}) == 64);
    CHECK(large({"--samples", "0:24"}) == 24);
    CHECK(large({"--noise", "99%"}) != 8);
    CHECK(large({"--part", folder.path("a.part.exr")}) == 64);
    // The samples are those of a render that is asked for as many.
    REQUIRE(large({"--spp", "8"}) == 8);
    const PngFile asked = read_png(png);
    REQUIRE(large({}) == 8);
    CHECK(read_png(png).values == asked.values);
}

TEST_CASE("what is denoised by default is said")
{
    const DenoiseFolder folder;
    const auto render = [&](Words more, const char* library) {
        Words words{"render", folder.path("cube.gltf"),
                    "--size", "8x4",
                    "--spp",  "4",
                    "-o",     folder.path("a.png"),
                    "-o",     folder.path("a.exr")};
        words.insert(words.end(), more.begin(), more.end());
        return run({.arguments = words, .environment = {{"BDPT_DENOISER", library}}});
    };
    const std::string hint = "denoised (--denoise=false writes it as it is)";
    const std::string text = render({}, BDPT_FAKE_OIDN).err;
    CHECK(text.find(hint) != std::string::npos);
    CHECK(text.find(hint) == text.rfind(hint));  // of the .png file alone
    CHECK(text.find("before denoising: more --time or --spp") != std::string::npos);
    const std::string asked = render({"--denoise"}, BDPT_FAKE_OIDN).err;
    CHECK(asked.find(", denoised\n") != asked.rfind(", denoised\n"));
    CHECK(asked.find(hint) == std::string::npos);
    const std::string absent = render({}, "").err;
    CHECK(absent.find("denoised") == std::string::npos);
    CHECK(absent.find("or install Open Image Denoise") != std::string::npos);
    CHECK(render({"--denoise=false"}, "").err.find(", or --denoise\n") != std::string::npos);
    const auto done = nlohmann::json::parse(render({"--json", "--quiet"}, BDPT_FAKE_OIDN).out);
    CHECK(done["denoised"] == nlohmann::json::array({folder.path("a.png")}));
    CHECK(nlohmann::json::parse(render({"--json", "--quiet"}, "").out)["denoised"].empty());
}

TEST_CASE("a picture that nobody wanted to be denoised is not lost with its denoiser")
{
    const DenoiseFolder folder;
    const auto render = [&](const char* name, const Words& more, const char* fault) {
        Words words{"-o", folder.path(name), "--denoiser-library", BDPT_FAKE_OIDN};
        words.insert(words.end(), more.begin(), more.end());
        return folder.render(words, {{"BDPT_FAKE_OIDN", fault}});
    };
    REQUIRE(render("noisy.png", {"--denoise=false"}, "").exit_code == 0);
    const PngFile noisy = read_png(folder.path("noisy.png"));
    const Outcome failed = render("a.png", {}, "fail");
    CHECK(failed.exit_code == 0);
    CHECK(read_png(folder.path("a.png")).values == noisy.values);
    CHECK(render("a.png", {"--quiet=false"}, "fail")
              .err.find("not denoised: the denoiser failed: it was asked to fail") !=
          std::string::npos);
    // There is too little memory for the denoiser.
    const Outcome small = render("b.png", {"--max-memory", "60M"}, "");
    CHECK(small.exit_code == 0);
    CHECK(read_png(folder.path("b.png")).values == noisy.values);
    // A library that is named has to be there.
    CHECK(folder.render({"-o", folder.path("c.png"), "--denoiser-library", folder.path("none.so")})
              .exit_code == 5);
    CHECK_FALSE(folder.has("c.png"));
}

TEST_CASE("parts are what they are without a denoiser, and merged pictures denoised with layers")
{
    const DenoiseFolder folder;
    const auto part = [&](const std::string& name, const Words& more, const char* library) {
        Words words{"--part", folder.path(name + ".part.exr"), "-o", folder.path(name + ".png")};
        words.insert(words.end(), more.begin(), more.end());
        REQUIRE(folder.render(words, {{"BDPT_DENOISER", library}}).exit_code == 0);
    };
    const auto values = [&](const char* name) { return read_png(folder.path(name)).values; };
    part("auto", {}, BDPT_FAKE_OIDN);
    part("absent", {}, "");
    CHECK(values("auto.png") == values("absent.png"));
    // A part without layers goes on with and without the library.
    const Words more{"--spp", "8"};
    part("auto", more, "");
    part("absent", more, BDPT_FAKE_OIDN);
    CHECK(values("auto.png") == values("absent.png"));
    part("layers", {"--aov", "albedo,normal"}, BDPT_FAKE_OIDN);
    const auto merged = [&](const char* name, const char* library) {
        REQUIRE(run({.arguments = {"merge", folder.path(name), "-o", folder.path("m.png"), "-o",
                                   folder.path("m.exr"), "--quiet"},
                     .environment = {{"BDPT_DENOISER", library}}})
                    .exit_code == 0);
        CHECK(read_channels(folder.path("m.exr")).count("noisy.R") == 0);
        return values("m.png");
    };
    CHECK(merged("auto.part.exr", BDPT_FAKE_OIDN) == values("auto.png"));
    CHECK(merged("layers.part.exr", BDPT_FAKE_OIDN) == values("layers.png"));
    CHECK(merged("layers.part.exr", "") != values("layers.png"));
}

TEST_CASE("with --denoise=layer the denoised image is a layer")
{
    const DenoiseFolder folder;
    const Outcome outcome = folder.render(
        {"-o", folder.path("both.exr"), "--denoise=layer", "--denoiser-library", BDPT_FAKE_OIDN});
    REQUIRE(outcome.exit_code == 0);
    const ExrChannels both = read_channels(folder.path("both.exr"));
    CHECK(both.count("noisy.R") == 0);
    check_denoised(both, "denoised.", both);
}

TEST_CASE("parts are denoised when they are merged")
{
    const DenoiseFolder folder;
    const auto part = [&](const char* samples, const char* name) {
        return run({"render", folder.path("cube.gltf"), "--size", "8x4", "--quiet", "--spp", "4",
                    "--samples", samples, "--denoise", "--part", folder.path(name)})
            .exit_code;
    };
    // No image, no denoiser.
    REQUIRE(part("0:2", "a.part.exr") == 0);
    REQUIRE(part("2:4", "b.part.exr") == 0);
    REQUIRE(folder
                .render({"-o", folder.path("whole.exr"), "--denoise", "--denoiser-library",
                         BDPT_FAKE_OIDN})
                .exit_code == 0);
    REQUIRE(run({"merge", folder.path("b.part.exr"), folder.path("a.part.exr"), "-o",
                 folder.path("merged.exr"), "--denoise", "--denoiser-library", BDPT_FAKE_OIDN,
                 "--quiet"})
                .exit_code == 0);
    CHECK(read_channels(folder.path("merged.exr")) == read_channels(folder.path("whole.exr")));
}

TEST_CASE("a plan's parts are denoised when they are merged")
{
    const DenoiseFolder folder;
    const std::string plan = folder.path("job/plan.json");
    REQUIRE(run({"plan", folder.path("cube.gltf"), "--size", "8x4", "--spp", "4", "--parts", "2",
                 "--for", "make", "-o", folder.path("merged.exr"), "-d", folder.path("job"),
                 "--denoise", "--quiet"})
                .exit_code == 0);
    for (const char* task : {"0", "1"}) {
        REQUIRE(run({"render", "--plan", plan, "--task", task, "--quiet"}).exit_code == 0);
    }
    // Which code is loaded is for who merges to say.
    REQUIRE(
        run({"merge", "--plan", plan, "--denoiser-library", BDPT_FAKE_OIDN, "--quiet"}).exit_code ==
        0);
    REQUIRE(folder
                .render({"-o", folder.path("whole.exr"), "--denoise", "--denoiser-library",
                         BDPT_FAKE_OIDN})
                .exit_code == 0);
    CHECK(read_channels(folder.path("merged.exr")) == read_channels(folder.path("whole.exr")));
}

TEST_CASE("frames that are denoised have the same noise, unless that is switched off")
{
    // Nothing moves, so that the frames differ by noise alone.
    const DenoiseFolder folder;
    const auto are_equal = [&](const Words& more) {
        Words words{"--frames", "1:2", "--fps", "24", "-o", folder.path("f.#.exr")};
        words.insert(words.end(), more.begin(), more.end());
        REQUIRE(folder.render(words).exit_code == 0);
        const auto image = [&](const char* name) {
            return read_exr_channel(folder.path(name), "R");
        };
        return image("f.1.exr") == image("f.2.exr");
    };
    const Words denoised{"--denoise", "--denoiser-library", BDPT_FAKE_OIDN};
    CHECK(are_equal(denoised));
    CHECK_FALSE(are_equal({}));
    CHECK(are_equal({"--same-noise"}));
    Words fresh = denoised;
    fresh.push_back("--same-noise=false");
    CHECK_FALSE(are_equal(fresh));
    CHECK_FALSE(are_equal({"--same-noise=false"}));
    CHECK_FALSE(are_equal({"-o", folder.path("f.#.png"), "--denoiser-library", BDPT_FAKE_OIDN}));
}

TEST_CASE("without a denoiser nothing is rendered")
{
    const DenoiseFolder folder;
    const Outcome absent = folder.render(
        {"-o", folder.path("a.exr"), "--denoise", "--denoiser-library", folder.path("none.so")});
    CHECK(absent.exit_code == 5);
    CHECK(absent.err.find("none.so") != std::string::npos);
    CHECK_FALSE(folder.has("a.exr"));
    const Outcome empty =
        folder.render({"-o", folder.path("a.exr"), "--denoise", "--denoiser-library", ""});
    CHECK(empty.exit_code == 2);
    CHECK(empty.err.find("--denoiser-library \"\"") != std::string::npos);
    const Outcome word = folder.render({"-o", folder.path("a.exr"), "--denoise=much"});
    CHECK(word.exit_code == 2);
    CHECK(word.err.find("much") != std::string::npos);
}

TEST_CASE("a denoiser that fails is an error with its message")
{
    const DenoiseFolder folder;
    const Outcome outcome = folder.render(
        {"-o", folder.path("a.exr"), "--denoise", "--denoiser-library", BDPT_FAKE_OIDN},
        {{"BDPT_FAKE_OIDN", "fail"}});
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err.find("it was asked to fail") != std::string::npos);
    CHECK_FALSE(folder.has("a.exr"));
}

}  // namespace bdpt::test::denoise_test
