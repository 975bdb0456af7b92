#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::light_messages_test {
namespace {

/// What bdpt says while it renders `scene` small.
std::string said(const ScratchFolder& folder, const std::filesystem::path& scene,
                 const std::vector<std::string>& more = {})
{
    std::vector<std::string> words{
        "render", scene.string(), "-o", (folder / "out.exr").string(), "--spp", "1"};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
        words.insert(words.end(), {"--size", "16x8"});
    }
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.err + outcome.out;
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

const CubeFile one_lamp{
    .cameras = two_cameras + R"({"extensions": {"KHR_lights_punctual": {"light": 0}},
                          "translation": [0, 0, 4]},)",
    .more = R"("extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100}]}},)",
    .camera_nodes = 3};

TEST_CASE("the lights that are counted are those of the file and of --env")
{
    const ScratchFolder folder;
    const std::filesystem::path dark = write_cube(folder, "dark", {.cameras = two_cameras});
    CHECK(contains(said(folder, dark), "12 triangles, 0 lights;"));
    CHECK(contains(said(folder, dark, {"--env", "default"}), "12 triangles, 1 light;"));
    CHECK(contains(said(folder, dark, {"--json"}), R"("lights":0)"));
    CubeFile room = shining_room();
    room.material = R"({"pbrMetallicRoughness": {"metallicFactor": 0}})";
    CHECK(contains(said(folder, write_cube(folder, "room", room)), "12 triangles, 0 lights;"));
    CHECK(contains(said(folder, write_cube(folder, "lamp", one_lamp)), "12 triangles, 1 light;"));
    const std::filesystem::path bright =
        write_cube(folder, "bright", {.material = emissive_material, .cameras = two_cameras});
    CHECK(contains(said(folder, bright), "12 triangles (12 emissive), 0 lights;"));
}

/// The codes of the events "note" in lines of JSON.
std::vector<std::string> codes_of_notes(const std::string& lines)
{
    std::vector<std::string> codes;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) {
        const auto event = nlohmann::json::parse(line);
        if (event.at("event") == "note") {
            CHECK_FALSE(event.at("message").get<std::string>().empty());
            codes.push_back(event.at("code").get<std::string>());
        }
    }
    return codes;
}

TEST_CASE("programs get what was added to a scene as notes with codes")
{
    using Codes = std::vector<std::string>;
    const ScratchFolder folder;
    const std::filesystem::path bare = write_cube(folder, "bare", {});
    CHECK(codes_of_notes(said(folder, bare, {"--json"})) == Codes{"default_sky", "framed"});
    CHECK(codes_of_notes(said(folder, bare, {"--json", "--quiet"})).empty());
    CHECK(codes_of_notes(said(folder, write_cube(folder, "lit", one_lamp), {"--json"})).empty());
    CHECK(codes_of_notes(said(folder, bare, {"--json", "--view", "front", "--clamp", "0.001"})) ==
          Codes{"default_sky", "clamped"});
}

TEST_CASE("how a render was set up is told with --verbose, once for all images")
{
    const ScratchFolder folder;
    const std::filesystem::path scene = write_cube(folder, "lit", one_lamp);
    const std::vector<std::string> adaptive{"--adaptive",
                                            "--spp",
                                            "8",
                                            "--integrator",
                                            "mis",
                                            "--orbit",
                                            "2",
                                            "-o",
                                            (folder / "t.#.exr").string()};
    const std::string told = "noisy pixels get more samples";
    const auto run_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"render", scene.string(), "--size", "16x8"};
        words.insert(words.end(), adaptive.begin(), adaptive.end());
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.err;
    };
    CHECK_FALSE(contains(run_with({}), told));
    const std::string verbose = run_with({"-v"});
    CHECK(contains(verbose, told));
    CHECK(verbose.find(told) == verbose.rfind(told));
}

TEST_CASE("options that no output takes are named")
{
    const ScratchFolder folder;
    const std::filesystem::path scene = write_cube(folder, "lit", one_lamp);
    const std::string png = (folder / "only.png").string();
    const auto said_of = [&](const std::string& output, const std::vector<std::string>& more) {
        std::vector<std::string> words{"render", scene.string(), "--size", "16x8", "--spp",
                                       "1",      "-o",           output};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    CHECK(contains(said_of(png, {"--half"}), "--half has no effect: no output is .exr"));
    CHECK(contains(said_of(png, {"--tiled"}), "--tiled has no effect"));
    CHECK_FALSE(contains(said_of(png, {"--png-bits", "16"}), "no effect"));
    const std::string exr = (folder / "only.exr").string();
    CHECK_FALSE(contains(said_of(exr, {"--half", "--tiled"}), "no effect"));
    CHECK(contains(said_of(exr, {"--png-bits", "16"}), "--png-bits 16 has no effect"));
    CHECK(contains(said_of(exr, {"--tone-map", "agx"}), "--tone-map has no effect"));
    const std::vector<std::string> library{"--denoiser-library", BDPT_FAKE_OIDN};
    const std::string unused = "--denoiser-library has no effect: no output is denoised";
    CHECK(contains(said_of(exr, library), unused));
    CHECK_FALSE(contains(said_of(png, library), unused));
    const auto with = [&](const char* denoise) {
        return std::vector<std::string>{library[0], library[1], denoise};
    };
    CHECK_FALSE(contains(said_of(exr, with("--denoise")), unused));
    CHECK(contains(said_of(png, with("--denoise=false")), unused));
}

/// A grey cube, and behind it where the camera sees none of its light a tiny one that shines.
std::filesystem::path token_emitter(const ScratchFolder& folder)
{
    const std::filesystem::path scene = write_cube(folder, "token", {.cameras = two_cameras});
    nlohmann::json document = nlohmann::json::parse(std::ifstream(scene));
    nlohmann::json small = document["meshes"][0];
    small["primitives"][0]["material"] = document["materials"].size();
    document["materials"].push_back({{"emissiveFactor", {1, 1, 1}}});
    document["scenes"][0]["nodes"].push_back(document["nodes"].size());
    document["nodes"].push_back({{"mesh", document["meshes"].size()},
                                 {"scale", {0.01, 0.01, 0.01}},
                                 {"translation", {0, 0, -3}}});
    document["meshes"].push_back(small);
    write_text(scene, document.dump());
    return scene;
}

const std::string glows = "no light but emissive materials: lit by a key and a rim light";

TEST_CASE("a scene without light but for a token emitter is lit by the sky, and it is said")
{
    const ScratchFolder folder;
    const std::filesystem::path scene = token_emitter(folder);
    const std::string note = said(folder, scene);
    CAPTURE(note);
    CHECK(contains(note, "bdpt: " + scene.string() + ": " + glows));
    CHECK(contains(note, "--env none"));
    CHECK_FALSE(contains(note, "warning"));
    CHECK_FALSE(contains(said(folder, scene, {"--json"}), "warning"));
    CHECK(contains(said(folder, scene, {"--json"}), R"("environment":"object")"));
    for (const char* environment : {"default", "none"}) {
        CHECK_FALSE(contains(said(folder, scene, {"--env", environment}), "no light"));
    }
    CHECK_FALSE(contains(said(folder, write_cube(folder, "lamp", one_lamp)), "no light"));
}

/// A cube that shines with `radiance` [nit] on a floor.
std::filesystem::path cube_on_floor(const ScratchFolder& folder, double radiance)
{
    const std::filesystem::path scene = write_cube(folder, "shining", {});
    nlohmann::json document = nlohmann::json::parse(std::ifstream(scene));
    nlohmann::json floor = document["meshes"][0];
    floor["primitives"][0]["material"] = 1;
    document["materials"].push_back(document["materials"][0]);
    document["materials"][0]["emissiveFactor"] = {radiance, radiance, radiance};
    document["scenes"][0]["nodes"].push_back(document["nodes"].size());
    document["nodes"].push_back({{"mesh", document["meshes"].size()},
                                 {"scale", {2.5, 0.01, 2.5}},
                                 {"translation", {0, -1.01, 0}}});
    document["meshes"].push_back(floor);
    write_text(scene, document.dump());
    return scene;
}

TEST_CASE("the size of an image does not decide whether a scene gets a sky")
{
    const ScratchFolder folder;
    for (const double radiance : {0.35, 0.4, 0.45}) {  // nearly bright enough, and just so
        const std::filesystem::path scene = cube_on_floor(folder, radiance);
        const auto has_sky = [&](const char* size) {
            return contains(said(folder, scene, {"--json", "--size", size}),
                            R"("environment":"object")");
        };
        for (const char* size : {"64x48", "36x64", "96x16"}) {
            CAPTURE(radiance, size);
            CHECK(has_sky(size) == has_sky("64x36"));
        }
    }
}

TEST_CASE("a black image is told, and no other, whatever lights there are")
{
    const ScratchFolder folder;
    const std::string black = "black";
    const std::filesystem::path dark = write_cube(folder, "dark", {.cameras = two_cameras});
    CHECK(contains(said(folder, dark, {"--env", "none"}),
                   "warning: " + dark.string() + ": no light: the image will be black"));
    CHECK_FALSE(contains(said(folder, dark), black));
    // What is unlit is seen without any light.
    const std::filesystem::path unlit =
        write_cube(folder, "unlit",
                   {.material = R"({"extensions": {"KHR_materials_unlit": {}}})",
                    .cameras = two_cameras,
                    .more = R"("extensionsUsed": ["KHR_materials_unlit"],)"});
    CHECK_FALSE(contains(said(folder, unlit, {"--env", "none"}), black));
    // The studio lights do not reach the inside of a room.
    CubeFile room = shining_room();
    room.material = R"({"pbrMetallicRoughness": {"metallicFactor": 0}})";
    const std::filesystem::path cave = write_cube(folder, "cave", room);
    CHECK(contains(said(folder, cave, {"--env", "studio"}),
                   "warning: " + cave.string() + ": the image is black: "));
    CHECK_FALSE(contains(said(folder, cave), black));
    // A region beside the cube is black before nothing, and it should be.
    CHECK_FALSE(contains(
        said(folder, dark, {"--env", "studio", "--aov", "alpha", "--crop", "0,0,2,2"}), black));
}

TEST_CASE("a closed room that its emitters light gets no lamp and no sky")
{
    const ScratchFolder folder;
    const std::filesystem::path room = write_cube(folder, "room", shining_room());
    const std::string words = said(folder, room, {"--json", "--env-rotation", "90"});
    CAPTURE(words);
    CHECK(contains(words, R"("environment":"none")"));
    CHECK(contains(words, "no environment: --env-rotation and --env-intensity have no effect"));
    CHECK_FALSE(contains(words, "lamp was added"));
}

}  // namespace
}  // namespace bdpt::test::light_messages_test
