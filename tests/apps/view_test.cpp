#include "options/groups/view_arguments.h"

#include <bdpt/error.h>
#include <bdpt/scene.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "stage/prepared_scene.h"

namespace bdpt::job::view_test {
namespace {

std::vector<CameraDesc> cameras()
{
    std::vector<CameraDesc> result;
    for (std::string name : {"main", "2", "side"}) {
        result.emplace_back().name = std::move(name);
    }
    return result;
}

TEST_CASE("a camera is selected by name, then by index")
{
    const std::vector<CameraDesc> list = cameras();
    CHECK(&select_camera(list, "side", "a.gltf") == &list[2]);
    CHECK(&select_camera(list, "0", "a.gltf") == &list[0]);
    CHECK(&select_camera(list, "2", "a.gltf") == &list[1]);
    for (const char* wrong : {"3", "top", "", "-1"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(select_camera(list, wrong, "a.gltf"), Error);
    }
    try {
        (void)select_camera(list, "top", "a.gltf");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::not_found);
        CHECK(
            std::string(error.what()) ==
            "a.gltf: no camera \"top\"; this scene has 3 cameras: 0 \"main\", 1 \"2\", 2 \"side\"");
    }
}

TEST_CASE("a camera without a name is listed by its index")
{
    std::vector<CameraDesc> list(2);
    list[1].name = "side";
    try {
        (void)select_camera(list, "top", "a.gltf");
        FAIL("a camera was found");
    } catch (const Error& error) {
        CHECK(std::string(error.what()) ==
              "a.gltf: no camera \"top\"; this scene has 2 cameras: 0, 1 \"side\"");
    }
}

/// Where `camera` looks.
Vec3 forward(const CameraDesc& camera)
{
    return -Vec3(camera.world_from_camera[2]);
}

void check_direction(Vec3 is, Vec3 should)
{
    CAPTURE(is.x, is.y, is.z, should.x, should.y, should.z);
    CHECK(glm::distance(is, should) < 1e-5f);
}

TEST_CASE("a view is changed by what was given, and only by that")
{
    CameraDesc camera;
    camera.world_from_camera[3] = Vec4(0.0f, 1.0f, 4.0f, 1.0f);
    camera.vertical_fov = 0.5f;

    SECTION("nothing")
    {
        const CameraDesc same = apply({}, camera, Vec3(0.0f));
        CHECK(same.world_from_camera == camera.world_from_camera);
        CHECK(same.vertical_fov == 0.5f);
    }
    SECTION("the field of view")
    {
        const CameraDesc wide = apply({.vertical_fov = 1.0f}, camera, Vec3(0.0f));
        CHECK(wide.world_from_camera == camera.world_from_camera);
        CHECK(wide.vertical_fov == 1.0f);
    }
    SECTION("the target")
    {
        const CameraDesc turned = apply({.look_at = Vec3(4.0f, 1.0f, 4.0f)}, camera, std::nullopt);
        CHECK(turned.world_from_camera[3] == camera.world_from_camera[3]);
        check_direction(forward(turned), Vec3(1.0f, 0.0f, 0.0f));
        check_direction(Vec3(turned.world_from_camera[1]), Vec3(0.0f, 1.0f, 0.0f));
    }
    SECTION("the place of a camera of the file: its direction stays")
    {
        const CameraDesc moved = apply({.from = Vec3(7.0f)}, camera, std::nullopt);
        CHECK(Vec3(moved.world_from_camera[3]) == Vec3(7.0f));
        check_direction(forward(moved), Vec3(0.0f, 0.0f, -1.0f));
    }
    SECTION("the place of an automatic camera: it turns to the target")
    {
        const CameraDesc moved = apply({.from = Vec3(9.0f, 0.0f, 0.0f)}, camera, Vec3(0.0f));
        check_direction(forward(moved), Vec3(-1.0f, 0.0f, 0.0f));
    }
    SECTION("straight down")
    {
        const CameraDesc down =
            apply({.from = Vec3(0.0f, 5.0f, 0.0f), .look_at = Vec3(0.0f)}, camera, std::nullopt);
        check_direction(forward(down), Vec3(0.0f, -1.0f, 0.0f));
        check_direction(Vec3(down.world_from_camera[1]), Vec3(0.0f, 0.0f, -1.0f));
        CHECK(glm::determinant(Mat3(down.world_from_camera)) == Approx(1.0f));
    }
    SECTION("a camera cannot look at itself")
    {
        CHECK_THROWS_AS(apply({.look_at = Vec3(0.0f, 1.0f, 4.0f)}, camera, std::nullopt), Error);
    }
}

TEST_CASE("the default size is the largest in 1280 x 720 with the camera's aspect ratio")
{
    const auto check = [](std::optional<float> aspect, int width, int height) {
        const Size size = default_size(aspect);
        CAPTURE(aspect.value_or(0.0f));
        CHECK(size.width == width);
        CHECK(size.height == height);
    };
    check(std::nullopt, 1280, 720);
    check(16.0f / 9.0f, 1280, 720);
    check(1.0f, 720, 720);
    check(1.5f, 1080, 720);
    check(2.0f, 1280, 640);
    check(0.5f, 360, 720);
    check(1e30f, 1280, 1);
    check(1e-30f, 1, 720);
    check(0.0f, 1280, 720);
    check(-1.0f, 1280, 720);
}

TEST_CASE("the middle of a shifted film is in focus, and what the film shows fills it")
{
    // A wall 3 m away, from 1 m to 9 m to the right of the axis.
    MeshDesc wall;
    wall.positions = {{1, -1, -3}, {9, -1, -3}, {9, 1, -3}, {1, 1, -3}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    SceneDesc desc;
    desc.meshes = {wall};
    desc.materials.resize(1);
    desc.instances.push_back({.mesh = MeshId{0}, .material = MaterialId{0}});
    const Scene scene(std::move(desc));
    const Size size{.width = 40, .height = 20};
    CameraDesc camera;
    camera.vertical_fov = 2.0f * std::atan(0.25f);  // the film is 3 m x 1.5 m there
    CHECK_THROWS_AS(with_lens({.radius = 0.1}, camera, scene, size), Error);
    CHECK(filled_share(scene, camera, 2.0f) == Approx(0.5 / 3.0).margin(0.02));
    camera.shift.x = 1.5f;
    CHECK(with_lens({.radius = 0.1}, camera, scene, size).focus_distance == Approx(3.0f));
    CHECK(filled_share(scene, camera, 2.0f) == 1.0);
    camera.shift.y = 1.0f;  // from 0.75 m upwards
    CHECK_THROWS_AS(with_lens({.radius = 0.1}, camera, scene, size), Error);
    CHECK(filled_share(scene, camera, 2.0f) == Approx(0.25 / 1.5).margin(0.02));
    camera.shift = Vec2(0.0f);
    camera.pixel_aspect = 2.0f;  // 6 m wide
    CHECK(filled_share(scene, camera, 2.0f) == Approx(2.0 / 6.0).margin(0.02));
}

}  // namespace
}  // namespace bdpt::job::view_test
