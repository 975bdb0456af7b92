#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "catch.hpp"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::info_test {
namespace {

TEST_CASE("info tells people what a file holds")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const Outcome outcome = run({"info", scene});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    for (const char* text :
         {"2.0", "bdpt tests", "12 in meshes, 12 in the scene", "0 \"front\" at 0,0,5",
          "1 \"side\" at 5,0,0", "-1,-1,-1 to 1,1,1 m", "no light: a render adds lights"}) {
        CAPTURE(text);
        CHECK(outcome.out.find(text) != std::string::npos);
    }
    CHECK(outcome.out.find("no camera") == std::string::npos);
}

TEST_CASE("info tells which kind of camera and lens there is")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.cameras = two_cameras, .camera_kinds = special_cameras})
            .string();
    const std::string text = run({"info", scene}).out;
    CAPTURE(text);
    CHECK(text.find("orthographic, 3 m high, aspect ratio 2") != std::string::npos);
    CHECK(text.find("perspective, vertical field of view 22.92 degrees, lens radius 0.5 m, "
                    "focused at 4 m") != std::string::npos);
    const auto cameras = nlohmann::json::parse(run({"info", scene, "--json"}).out)["cameras"];
    REQUIRE(cameras.size() == 2);
    CHECK(cameras[0]["projection"] == "orthographic");
    CHECK(cameras[0]["vertical_extent"] == 3.0);
    CHECK_FALSE(cameras[0].contains("vertical_fov_degrees"));
    CHECK(cameras[1]["projection"] == "perspective");
    CHECK(cameras[1]["lens_radius"] == 0.5);
    CHECK(cameras[1]["focus_distance"] == 4.0);
}

TEST_CASE("names in a file cannot give orders to the terminal")
{
    const ScratchFolder folder;
    // CSI in one byte of C1, and a text that runs backwards.
    const std::string scene =
        write_cube(folder, "cube", {.cameras = R"({"name": "a\u009b31mb", "camera": 0},
                                  {"name": "c\u202ed", "camera": 1},)"})
            .string();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", scene},
          {"info", scene, "--json"},
          {"inspect", scene, "--camera", "0", "--pixel", "1,1", "--size", "4x4"},
          {"render", scene, "--camera", "1", "-o", (folder / "a.exr").string(), "--spp", "1",
           "--size", "4x4"},
          {"render", scene, "--camera",
           "c\xe2\x80\xae"
           "e",
           "-o", (folder / "a.exr").string()},
          {"render", scene, "--cameras", "all", "-o", (folder / "{camera}.exr").string(), "--json",
           "--spp", "1", "--size", "4x4"}}) {
        const Outcome outcome = run(words);
        const std::string all = outcome.out + outcome.err;
        CAPTURE(all);
        CHECK(all.find("\xc2\x9b") == std::string::npos);
        CHECK(all.find("\xe2\x80\xae") == std::string::npos);
        CHECK(all.find(words[0] == "render" ? "bdpt" : "a") != std::string::npos);
    }
    const auto json = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    CHECK(json.dump().find("\xc2\x9b") != std::string::npos);
}

TEST_CASE("info --json tells programs the same")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube",
                                         {.material = emissive_material,
                                          .cameras = two_cameras,
                                          .more = R"("extensionsUsed": ["ACME_shiny"],)"})
                                  .string();
    const Outcome outcome = run({"info", scene, "--json"});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    const auto info = nlohmann::json::parse(outcome.out);
    CHECK(info["file"] == scene);
    CHECK(info["gltf_version"] == "2.0");
    CHECK(info["generator"] == "bdpt tests");
    CHECK(info["scenes"] == nlohmann::json::array({"main"}));
    CHECK(info["scene"] == 0);
    CHECK(info["triangles"]["in_scene"] == 12);
    CHECK(info["triangles"]["emissive"] == 12);
    CHECK(info["counts"]["instances"] == 1);
    CHECK(info["bounds"]["max"] == nlohmann::json::array({1.0, 1.0, 1.0}));
    REQUIRE(info["cameras"].size() == 2);
    CHECK(info["cameras"][0]["name"] == "front");
    CHECK(info["cameras"][1]["aspect_ratio"] == 1.0);
    CHECK(info["emissive_materials"].size() == 1);
    REQUIRE(info["extensions"].size() == 1);
    CHECK(info["extensions"][0]["name"] == "ACME_shiny");
    CHECK(info["extensions"][0]["status"] == "unknown");
    CHECK(info["extensions"][0]["required"] == false);
    CHECK(info["defaults"] == nlohmann::json::array({"sky"}));
}

TEST_CASE("info takes a scene without anything to see")
{
    const ScratchFolder folder;
    const std::string scene = (folder / "empty.gltf").string();
    write_text(scene, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})");
    const Outcome outcome = run({"info", scene});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.find("nothing to render") != std::string::npos);
}

/// A file that requires what nobody has.
std::string magic_cube(const ScratchFolder& folder)
{
    return write_cube(folder, "magic",
                      {.cameras = two_cameras, .more = R"("extensionsUsed": ["ACME_magic"],
                                  "extensionsRequired": ["ACME_magic"],)"})
        .string();
}

TEST_CASE("info tells what is in a file that cannot be rendered, and why it cannot")
{
    const ScratchFolder folder;
    std::string scene = magic_cube(folder);
    std::string reason = "ACME_magic";
    int code = 5;
    SECTION("a required extension that is not supported") {}
    SECTION("a buffer that is missing")
    {
        scene = write_cube(folder, "blind", {.cameras = two_cameras}).string();
        std::filesystem::remove(folder / "blind.bin");
        reason = "blind.bin";
        code = 3;
    }
    SECTION("an index out of range")
    {
        scene = write_cube(folder, "bad", {.cameras = two_cameras}).string();
        std::string text = read_text(scene);
        const std::string_view good = "\"POSITION\": 0";
        text.replace(text.find(good), good.size(), "\"POSITION\": 9");
        write_text(scene, text);
        reason = "POSITION";
        code = 4;
    }
    const Outcome outcome = run({"info", scene});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("generator   bdpt tests") != std::string::npos);
    CHECK(outcome.out.find("meshes      1 of 1 primitives") != std::string::npos);
    CHECK(outcome.out.find("cameras     2\n") != std::string::npos);
    const std::string head = "rendering   would fail with exit code " + std::to_string(code) + ": ";
    CHECK(outcome.out.find(head) != std::string::npos);
    CHECK(outcome.out.find(reason, outcome.out.find(head)) != std::string::npos);
    const auto info = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    CHECK(info["renderable"] == false);
    CHECK(info["problem"]["code"] == code);
    CHECK(info["problem"]["message"].get<std::string>().find(reason) != std::string::npos);
    CHECK(info["counts"]["nodes"] == 3);
    CHECK(info["triangles"].is_null());
    const Outcome render = run({"render", scene, "-o", (folder / "out.exr").string()});
    CHECK(render.exit_code == code);
    CHECK(render.err == "bdpt: error: " + info["problem"]["message"].get<std::string>() + "\n");
}

TEST_CASE("info refuses what is no glTF file, or a choice that there is not")
{
    const ScratchFolder folder;
    const std::string bad = (folder / "bad.gltf").string();
    for (const char* text : {"", "{\"asset\": ", "[1, 2]", "{}", "{\"asset\": 3}"}) {
        write_text(bad, text);
        const Outcome outcome = run({"info", bad});
        CAPTURE(text, outcome.out, outcome.err);
        CHECK(outcome.exit_code == 4);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("bdpt: error: " + bad));
    }
    const std::string scene = write_cube(folder, "cube", {}).string();
    CHECK(run({"info", scene, "--scene", "attic"}).exit_code == 3);
    CHECK(run({"info", scene, "--variant", "dusk"}).exit_code == 3);
}

TEST_CASE("info --json has data under keys that stay, not sentences")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube",
                   {.material = R"({"name": "glow", "emissiveFactor": [1, 0.5, 0]})",
                    .cameras = R"({"name": "lamp", "translation": [1, 2, 3],
                        "extensions": {"KHR_lights_punctual": {"light": 0}}},
                        {"extensions": {"KHR_lights_punctual": {"light": 1}}},)",
                    .more = R"("extensionsUsed": ["KHR_lights_punctual"],
                        "extensions": {"KHR_lights_punctual": {"lights": [
                            {"type": "point", "name": "bulb", "intensity": 5},
                            {"type": "directional", "name": "sun", "intensity": 2}]}},)",
                    .camera_nodes = 2})
            .string();
    const auto info = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    CAPTURE(info.dump());
    CHECK(info["renderable"] == true);
    CHECK(info["problem"].is_null());
    CHECK(info["emissive_materials"] ==
          nlohmann::json::parse(R"([{"name": "glow", "emission": [1.0, 0.5, 0.0]}])"));
    CHECK(info["texture_sizes"] == nlohmann::json::array());
    CHECK(info["defaults"] == nlohmann::json::array({"camera"}));
    CHECK(info["lights"] == nlohmann::json::parse(R"([
        {"kind": "point", "name": "bulb", "position": [1.0, 2.0, 3.0],
         "intensity": [5.0, 5.0, 5.0], "radius": 0.0},
        {"kind": "directional", "name": "sun", "direction": [0.0, 0.0, -1.0],
         "illuminance": [2.0, 2.0, 2.0]}])"));
    const std::string text = run({"info", scene}).out;
    CAPTURE(text);
    CHECK(text.find("point \"bulb\" at 1,2,3, 5,5,5 cd\n") != std::string::npos);
    CHECK(text.find("directional \"sun\" towards 0,0,-1, 2,2,2 lx\n") != std::string::npos);
    const std::string dark = write_cube(folder, "dark", {}).string();
    CHECK(nlohmann::json::parse(run({"info", dark, "--json"}).out)["defaults"] ==
          nlohmann::json::array({"camera", "sky"}));
}

TEST_CASE("info reads what others made")
{
    const char* assets = std::getenv("BDPT_TEST_ASSETS");
    if (assets == nullptr) {
        WARN("skipped: BDPT_TEST_ASSETS names no folder with real files");
        return;
    }
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets)) {
        if (entry.path().extension() != ".glb" ||
            entry.path().string().find("/hostile/") != std::string::npos) {
            continue;
        }
        const Outcome outcome = run({"info", entry.path().string(), "--json"});
        CAPTURE(entry.path().string(), outcome.err);
        CHECK(outcome.exit_code == 0);
        REQUIRE(nlohmann::json::accept(outcome.out));
        // Unsupported ones are told as such, and nothing worse happens.
        const auto info = nlohmann::json::parse(outcome.out);
        CHECK((info["renderable"] == true || info["problem"]["code"] == 5));
        ++count;
    }
    CHECK(count > 0);
}

}  // namespace
}  // namespace bdpt::test::info_test
