#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::distant_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// Where the scene stands on its map; x is a multiple of its size.
constexpr double map_x = 128000.0;
constexpr double map_z = -64000.0;

/// The nodes of `two_cameras` and a lamp, which stand around a cube.
const std::string furnished =
    two_cameras +
    R"({"name": "lamp", "translation": [0, 3, 4], "extensions": {"KHR_lights_punctual": {"light": 0}}},)";

/// Writes "near.gltf", and "far.gltf" with the same scene on the map.
void write_scenes(const ScratchFolder& folder)
{
    const std::filesystem::path near =
        write_cube(folder, "near",
                   {.cameras = furnished,
                    .more = R"("extensionsUsed": ["KHR_lights_punctual"],
                    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},)",
                    .camera_nodes = 3});
    json scene = json::parse(std::ifstream(near));
    json& roots = scene["scenes"][0]["nodes"];
    scene["nodes"].push_back({{"children", roots}, {"translation", {map_x, 0, map_z}}});
    roots = {scene["nodes"].size() - 1};
    write_text(folder / "far.gltf", scene.dump());
}

struct Rendered {
    std::filesystem::path file;
    Imath::M44f camera_from_file;
};

Rendered render(const ScratchFolder& folder, const std::string& scene, const Words& more)
{
    Rendered result{folder / (scene + ".exr"), {}};
    Words words{"render",    (folder / (scene + ".gltf")).string(),
                "-o",        result.file.string(),
                "--size",    "12x12",
                "--spp",     "4",
                "--aov",     "position,depth",
                "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    result.camera_from_file = Imf::worldToCamera(Imf::InputFile(result.file.c_str()).header());
    return result;
}

/// Checks that both show the same picture, and that positions in `far` are on the map, where its
/// camera is, too.
void check_same(const Rendered& near, const Rendered& far)
{
    for (const char* channel : {"R", "G", "B", "depth.Z", "position.Y"}) {
        CAPTURE(channel);
        CHECK(read_exr_channel(far.file, channel) == read_exr_channel(near.file, channel));
    }
    const std::vector<float> depth = read_exr_channel(far.file, "depth.Z");
    const std::vector<float> x = read_exr_channel(far.file, "position.X");
    const std::vector<float> y = read_exr_channel(far.file, "position.Y");
    const std::vector<float> z = read_exr_channel(far.file, "position.Z");
    const std::vector<float> near_x = read_exr_channel(near.file, "position.X");
    std::size_t hits = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (!std::isfinite(depth[i])) {
            continue;
        }
        ++hits;
        CHECK(static_cast<double>(x[i]) - map_x == Approx(near_x[i]).margin(0.02));
        Imath::V3f in_camera;
        far.camera_from_file.multVecMatrix(Imath::V3f(x[i], y[i], z[i]), in_camera);
        CHECK(in_camera.z == Approx(depth[i]).margin(0.05));
    }
    CHECK(hits > 10);
}

}  // namespace

TEST_CASE("a scene on a map gives the picture of one at the origin", "[distant]")
{
    const ScratchFolder folder;
    write_scenes(folder);
    check_same(render(folder, "near", {}), render(folder, "far", {}));
    check_same(render(folder, "near", {"--camera", "side"}),
               render(folder, "far", {"--camera", "side"}));
    check_same(render(folder, "near", {"--view", "three-quarter"}),
               render(folder, "far", {"--view", "three-quarter"}));
}

TEST_CASE("a viewpoint is in coordinates of the file", "[distant]")
{
    const ScratchFolder folder;
    write_scenes(folder);
    check_same(render(folder, "near", {"--from", "3.3,2,4.7", "--look-at", "0.1,0,-0.2"}),
               render(folder, "far",
                      {"--from", "128003.3,2,-63995.3", "--look-at", "128000.1,0,-64000.2"}));
    check_same(render(folder, "near", {"--from", "0.5,0,6"}),
               render(folder, "far", {"--from", "128000.5,0,-63994"}));
}

TEST_CASE("info tells coordinates of the file", "[distant]")
{
    const ScratchFolder folder;
    write_scenes(folder);
    const std::string scene = (folder / "far.gltf").string();
    const json report = json::parse(run({"info", scene, "--json"}).out);
    CHECK(report["bounds"]["min"] == json({map_x - 1, -1.0, map_z - 1}));
    CHECK(report["bounds"]["max"] == json({map_x + 1, 1.0, map_z + 1}));
    CHECK(report["cameras"][0]["position"] == json({map_x, 0.0, map_z + 5}));
    CHECK(report["lights"][0]["position"] == json({map_x, 3.0, map_z + 4}));
    const std::string text = run({"info", scene}).out;
    CAPTURE(text);
    for (const char* part : {"127999,-1,-64001 to 128001,1,-63999 m", "at 128005,0,-64000",
                             "\"lamp\" at 128000,3,-63996"}) {
        CHECK(text.find(part) != std::string::npos);
    }
}

TEST_CASE("inspect tells coordinates of the file", "[distant]")
{
    const ScratchFolder folder;
    write_scenes(folder);
    const json report =
        json::parse(run({"inspect", (folder / "far.gltf").string(), "--size", "16x16", "--pixel",
                         "8,8", "--integrator", "mis", "--json"})
                        .out);
    CHECK(report["camera_path"][0]["position"] == json({map_x, 0.0, map_z + 5}));
    CHECK(report["camera_path"][1]["position"][2].get<double>() == Approx(map_z + 1).epsilon(1e-9));
}

}  // namespace bdpt::test::distant_test
