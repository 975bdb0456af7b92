#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::render_test {
namespace {

using Words = std::vector<std::string>;

/// Renders `scene` small and quickly, with `more` options, and reads the image.
ExrFile render(const ScratchFolder& folder, const std::string& scene, const Words& more)
{
    const std::string out = (folder / "out.exr").string();
    Words words{"render", scene, "-o", out, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    CAPTURE(words, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return read_exr(out);
}

double mean(const Image& image)
{
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) {
        sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3.0;
    }
    return sum / static_cast<double>(image.pixels.size());
}

bool same_bits(const Image& a, const Image& b)
{
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

nlohmann::json settings_of(const ExrFile& file)
{
    return nlohmann::json::parse(file.text("bdpt.settings"));
}

std::vector<nlohmann::json> events_of(const std::string& out)
{
    std::vector<nlohmann::json> events;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
        events.push_back(nlohmann::json::parse(line));
    }
    return events;
}

TEST_CASE("a file with neither camera nor light gives an image and notes")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string out = (folder / "out.exr").string();
    const Outcome outcome = run({"render", scene, "-o", out, "--spp", "2", "--size", "32x18"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.find("bdpt: " + scene + ": no camera") != std::string::npos);
    CHECK(outcome.err.find("bdpt: " + scene + ": no light") != std::string::npos);
    CHECK(outcome.err.find("warning") == std::string::npos);
    CHECK(outcome.err.find("lit by a key and a rim light") != std::string::npos);
    CHECK(outcome.err.find("a lamp was added") == std::string::npos);
    const Image image = read_exr(out).image;
    // The cube is in the middle, lit from the sky, which is all around it and has no dark places.
    CHECK(image.at(16, 9).g > 0.0f);
    for (int x = 0; x < image.width; ++x) {
        for (const int y : {0, image.height - 1}) {
            CAPTURE(x, y);
            CHECK(image.at(x, y).g > 0.1f);
        }
    }
    const Image own = [&] {
        const std::string none = (folder / "none.exr").string();
        REQUIRE(run({"render", scene, "-o", none, "--spp", "2", "--size", "32x18", "--env", "none"})
                    .exit_code == 0);
        return read_exr(none).image;
    }();
    CHECK(mean(own) == 0.0);
}

TEST_CASE("a closed room without light gets a lamp, and --env none takes it away")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "room", {.inside_out = true}).string();
    const std::string out = (folder / "out.exr").string();
    const Words words{"render", scene, "-o", out, "--spp", "4", "--size", "32x18"};
    const Outcome lit = run(words);
    CAPTURE(lit.err);
    REQUIRE(lit.exit_code == 0);
    CHECK(lit.err.find("a lamp was added") != std::string::npos);
    CHECK(mean(read_exr(out).image) > 0.01);

    Words dark = words;
    dark.insert(dark.end(), {"--env", "none"});
    const Outcome unlit = run(dark);
    REQUIRE(unlit.exit_code == 0);
    CHECK(unlit.err.find("the image will be black") != std::string::npos);
    CHECK(mean(read_exr(out).image) == 0.0);
}

TEST_CASE("a scene with light and camera is rendered as it is, without warnings")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    const std::string out = (folder / "out.exr").string();
    const Outcome outcome = run({"render", scene, "-o", out, "--spp", "2", "--env", "none"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.find("warning") == std::string::npos);
    const Image image = read_exr(out).image;
    // Camera 0 has an aspect ratio of 2.
    CHECK(image.width == 1280);
    CHECK(image.height == 640);
    CHECK(image.at(640, 320).g >= 1.0f);
    CHECK(image.at(0, 0) == Rgb(0.0f));
}

TEST_CASE("cameras are chosen and changed")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    const Words quick{"--spp", "1", "--size", "16x16", "--env", "none"};
    const auto view = [&](Words more) {
        more.insert(more.end(), quick.begin(), quick.end());
        return render(folder, scene, more);
    };
    /// The origin in the camera's left-handed space.
    const auto origin = [](const ExrFile& file) {
        Imath::V3f result;
        Imf::worldToCamera(file.header).multVecMatrix(Imath::V3f(0.0f), result);
        return result;
    };
    SECTION("by name and index")
    {
        CHECK(settings_of(view({}))["camera"] == "front");
        CHECK(settings_of(view({"--camera", "1"}))["camera"] == "side");
        const ExrFile side = view({"--camera", "side"});
        CHECK(settings_of(side)["vertical_fov_degrees"].get<double>() ==
              Approx(22.918).epsilon(1e-3));
        Imath::V3f point;
        Imf::worldToCamera(side.header).multVecMatrix(Imath::V3f(0.0f, 0.0f, -1.0f), point);
        CHECK(point.x == Approx(1.0f));
        CHECK(point.z == Approx(5.0f));
    }
    SECTION("automatically")
    {
        const ExrFile automatic = view({"--camera", "auto"});
        CHECK(settings_of(automatic)["camera"] == "auto");
        CHECK(origin(automatic).z > 1.7f);
        CHECK(automatic.image.at(8, 8).g > 0.0f);
    }
    SECTION("moved and turned")
    {
        const ExrFile moved = view({"--from", "0,0,20", "--look-at", "0,0,0", "--fov", "20"});
        CHECK(origin(moved).z == Approx(20.0f));
        CHECK(settings_of(moved)["vertical_fov_degrees"].get<double>() == Approx(20.0));
        CHECK(moved.image.at(8, 8).g > 0.0f);
        CHECK(moved.image.at(0, 0) == Rgb(0.0f));

        const ExrFile away = view({"--look-at", "0,0,9"});
        CHECK(mean(away.image) == 0.0);
        CHECK(origin(away).z == Approx(-5.0f));
    }
}

TEST_CASE("option --env chooses the light from all around")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    const Words quick{"--spp", "1", "--size", "16x8"};
    const auto corner = [&](Words more) {
        more.insert(more.end(), quick.begin(), quick.end());
        return render(folder, scene, more).image.at(0, 0).g;
    };
    CHECK(corner({"--env", "none"}) == 0.0f);
    CHECK(corner({}) == corner({"--env", "object"}));  // the cube glows, but lights nothing
    CHECK(corner({"--env", "object"}) > 0.2f);
    CHECK(corner({"--env", "default"}) > corner({"--env", "object"}));

    // The image of a file: its own output, which is a uniform 1 nit when the cube fills it.
    render(folder, scene, {"--spp", "1", "--size", "8x4", "--from", "0,0,1.01"});
    std::filesystem::rename(folder / "out.exr", folder / "sky.exr");
    CHECK(corner({"--env", (folder / "sky.exr").string()}) >= 1.0f);
}

TEST_CASE("a file's own environment shines, and --env takes its place")
{
    const ScratchFolder folder;
    // White images of one pixel on all sides, times 7.
    constexpr const char* more = R"(
        "extensionsUsed": ["EXT_lights_image_based"],
        "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg=="}],
        "extensions": {"EXT_lights_image_based": {"lights": [
            {"intensity": 7, "specularImageSize": 1, "specularImages": [[0, 0, 0, 0, 0, 0]]}]}},)";
    const std::string file =
        write_cube(folder, "cube", {.cameras = two_cameras, .more = more}).string();
    // The cube's file has one scene, which gets the environment here.
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string scenes = "\"scenes\": [{";
    REQUIRE(text.find(scenes) != std::string::npos);
    text.insert(text.find(scenes) + scenes.size(),
                R"("extensions": {"EXT_lights_image_based": {"light": 0}}, )");
    std::ofstream(file) << text;

    const auto corner = [&](const Words& more_words) {
        Words words{"--spp", "1", "--size", "16x8"};
        words.insert(words.end(), more_words.begin(), more_words.end());
        const ExrFile exr = render(folder, file, words);
        return std::pair(exr.image.at(0, 0).g, settings_of(exr)["environment"]);
    };
    const auto [own, own_name] = corner({});
    CHECK(own == Approx(7.0f));
    CHECK(own_name == "scene");
    const auto [sky, sky_name] = corner({"--env", "default"});
    CHECK((sky > 0.4f && sky < 3.0f));
    CHECK(sky_name == "default");
    CHECK(corner({"--env", "none"}).first == 0.0f);
}

TEST_CASE("the seed makes the image, the threads do not")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const Words base{
        "--spp", "4", "--size", "40x30", "--integrator", GENERATE("bdpt", "pt", "mis")};
    const auto with = [&](const Words& more) {
        Words words = base;
        words.insert(words.end(), more.begin(), more.end());
        return render(folder, scene, words).image;
    };
    const Image one = with({"--threads", "1", "--seed", "7"});
    CHECK(same_bits(one, with({"--threads", "3", "--seed", "7"})));
    CHECK_FALSE(same_bits(one, with({"--threads", "1", "--seed", "8"})));
}

TEST_CASE("integrators and path lengths agree on a scene of lamps only")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    // Paths of one edge see the lamp itself, which is 1 nit where the cube is.
    const Words quick{"--spp", "1", "--size", "16x8", "--max-depth", "1"};
    for (const std::string integrator : {"bdpt", "pt", "mis", "nee"}) {
        Words words = quick;
        words.insert(words.end(), {"--integrator", integrator});
        if (integrator == "bdpt") {
            // Points of the lamp that are joined to the lens have noise.
            words.insert(words.end(), {"--disable", "s1t1"});
        }
        const ExrFile file = render(folder, scene, words);
        CAPTURE(integrator);
        CHECK(file.image.at(8, 4) == Rgb(1.0f));
        CHECK(settings_of(file)["integrator"] == integrator);
        CHECK(settings_of(file)["max_depth"] == 1);
    }
}

TEST_CASE("option --time ends a render before its samples do")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const auto samples = [&](const Words& more) {
        Words words{"--size", "16x9", "--time", "0.2s"};
        words.insert(words.end(), more.begin(), more.end());
        const ExrFile file = render(folder, scene, words);
        return file.integer("bdpt.spp");
    };
    const int limited = samples({"--spp", "2000000000"});
    CHECK(limited >= 1);
    CHECK(limited < 2000000000);
    CHECK(samples({}) >= 1);
    CHECK(samples({"--spp", "1"}) == 1);
}

TEST_CASE("option --json prints one valid event a line")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string exr = (folder / "out.exr").string();
    const std::string png = (folder / "out.png").string();
    const Outcome outcome = run({"render", scene, "-o", exr, "-o", png, "--spp", "3", "--size",
                                 "32x18", "--env", "none", "--json"});
    CAPTURE(outcome.out, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    const std::vector<nlohmann::json> events = events_of(outcome.out);
    REQUIRE(events.size() >= 4);
    CHECK(events.front()["event"] == "start");
    CHECK(events.front()["version"] == BDPT_VERSION);
    CHECK(events.front()["file"] == scene);
    CHECK(events.front()["triangles"] == 12);
    CHECK(events.front()["settings"]["width"] == 32);
    int warnings = 0;
    int progress = 0;
    for (const nlohmann::json& event : events) {
        warnings += event["event"] == "warning" ? 1 : 0;
        progress += event["event"] == "progress" ? 1 : 0;
    }
    CHECK(warnings == 1);  // of the black image: what the file lacks are notes
    CHECK(progress >= 1);
    CHECK(events.back()["event"] == "done");
    CHECK(events.back()["samples"] == 3);
    CHECK(events.back()["outputs"] == nlohmann::json::array({exr, png}));
    CHECK(events.back()["exposure"].is_number());
    CHECK(events.back()["stopped_by"].is_null());
}

TEST_CASE("option --isa pins the instruction set, and the files say which one it was")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
    const std::string stats = (folder / "stats.json").string();
    const Words words{"--spp", "2", "--size", "16x8", "--stats", stats};
    const auto with_isa = [&](const char* isa) {
        Words result = words;
        result.insert(result.end(), {"--isa", isa});
        return result;
    };
    const ExrFile pinned = render(folder, scene, with_isa("sse2"));
    CHECK(settings_of(pinned)["isa"] == "sse2");
    CHECK(nlohmann::json::parse(read_text(stats))["settings"]["isa"] == "sse2");

    const ExrFile free = render(folder, scene, words);
    const std::string best = settings_of(free)["isa"];
    CHECK(best != "native");
    CHECK(nlohmann::json::parse(read_text(stats))["settings"]["isa"] == best);
    const ExrFile same = render(folder, scene, with_isa(best.c_str()));
    CHECK(same_bits(same.image, free.image));
    CHECK(same.text("bdpt.settings") == free.text("bdpt.settings"));
    CHECK(settings_of(render(folder, scene, with_isa("native")))["isa"] == best);
}

TEST_CASE("a scene of nothing but lights with a radius is rendered")
{
    const ScratchFolder folder;
    const std::string scene = (folder / "ball.gltf").string();
    const auto write = [&](const char* radius) {
        write_text(scene, std::string(R"({"asset": {"version": "2.0"}, "scene": 0,
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "point", "intensity": 3.14159265, "extras": {"radius": )") +
                              radius + R"(}}]}},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    };
    write("0.5");
    for (const char* integrator : {"bdpt", "mis", "lt"}) {
        const Image image =
            render(folder, scene,
                   {"--spp", "64", "--size", "16x16", "--from", "0,0,4", "--look-at", "0,0,0",
                    "--fov", "10", "--integrator", integrator})
                .image;
        CAPTURE(integrator);
        // Radiance I / (pi r^2).
        CHECK(image.at(8, 8).g == Approx(4.0f).epsilon(0.3));
        CHECK(mean(image) == Approx(4.0).epsilon(0.05));
    }
    const Image framed = render(folder, scene, {"--spp", "4", "--size", "16x16"}).image;
    CHECK(framed.at(8, 8).g == Approx(4.0f).epsilon(0.3));
    CHECK(framed.at(0, 0).g == 0.0f);
    CHECK(run({"info", scene}).out.find("nothing to render") == std::string::npos);

    write("0");
    const Outcome empty = run({"render", scene, "-o", (folder / "out.exr").string()});
    CHECK(empty.exit_code == 4);
    CHECK(empty.err.find("the scene is empty") != std::string::npos);
}

}  // namespace
}  // namespace bdpt::test::render_test
