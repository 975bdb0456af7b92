#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "catch.hpp"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test {
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
          "1 \"side\" at 5,0,0", "-1,-1,-1 to 1,1,1 m", "no light: a render adds a soft sky"}) {
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
    CHECK(info["defaults"].empty());
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
        // Unsupported ones are told as such, and nothing worse happens.
        CHECK((outcome.exit_code == 0 || outcome.exit_code == 5));
        CHECK(nlohmann::json::accept(outcome.out));
        ++count;
    }
    CHECK(count > 0);
}

}  // namespace
}  // namespace bdpt::test
