#include <bdpt/framing.h>

#include "camera/camera.h"
#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

namespace bdpt::framing_test {
namespace {

using test::SceneBuilder;

Vec3 eye(const FramedView& view)
{
    return Vec3(view.camera.world_from_camera[3]);
}

Vec3 forward(const FramedView& view)
{
    return -Vec3(view.camera.world_from_camera[2]);
}

}  // namespace

TEST_CASE("an object is framed whole, from the front, slightly above", "[framing]")
{
    for (const float size : {1e-3f, 1.0f, 1e4f}) {
        SceneBuilder builder;
        builder.sphere(Vec3(5.0f, 1.0f, -2.0f) * size, size, test::lambertian(Rgb(0.5f)));
        const Scene scene(std::move(builder.desc));
        for (const float aspect : {0.5f, 1.0f, 16.0f / 9.0f}) {
            const FramedView view = frame_scene(scene, aspect);
            CHECK_FALSE(view.enclosed);
            const Bounds bounds = scene.bounds();
            const Camera camera(view.camera, static_cast<int>(1000.0f * aspect), 1000);
            for (int corner = 0; corner < 8; ++corner) {
                CHECK(camera
                          .sample_lens({(corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                                        (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                                        (corner & 4) != 0 ? bounds.max.z : bounds.min.z},
                                       Vec2(0.5f))
                          .has_value());
            }
            CHECK(forward(view).z < -0.5f);
            CHECK(forward(view).y < -0.1f);
            CHECK(glm::distance(eye(view), Vec3(5.0f, 1.0f, -2.0f) * size) < 10.0f * size);
        }
    }
}

TEST_CASE("a closed room is framed from inside, with a lamp above", "[framing]")
{
    SceneBuilder builder;
    const MaterialDesc wall = test::lambertian(Rgb(0.7f));
    builder.walls(wall, wall).ceiling(wall).front(wall);
    builder.sphere({0.3f, -0.7f, 0.2f}, 0.3f, wall);
    const Scene scene(std::move(builder.desc));
    const FramedView view = frame_scene(scene, 1.5f);
    CHECK(view.enclosed);
    for (const Vec3 p : {eye(view), view.lamp_position}) {
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(std::abs(p[axis]) < 0.95f);
        }
    }
    CHECK(view.lamp_position.y > 0.3f);
}

TEST_CASE("a room without its front wall is looked into from there", "[framing]")
{
    SceneBuilder builder;
    const MaterialDesc wall = test::lambertian(Rgb(0.7f));
    builder.walls(wall, wall).ceiling(wall);
    builder.sphere({0.3f, -0.7f, 0.0f}, 0.3f, wall);
    const Scene scene(std::move(builder.desc));
    const FramedView view = frame_scene(scene, 1.0f);
    CHECK_FALSE(view.enclosed);
    CHECK(forward(view).z < -0.99f);
    CHECK(eye(view).z > 1.0f);
}

TEST_CASE("an empty scene still has a view", "[framing]")
{
    const FramedView view = frame_scene(Scene(SceneDesc{}), 1.0f);
    CHECK_FALSE(view.enclosed);
    CHECK(glm::length(forward(view)) == Approx(1.0f));
}

TEST_CASE("a camera that goes around stays level, at its distance, and moves as it did",
          "[framing]")
{
    CameraDesc camera;
    camera.world_from_camera[3] = {1.0f, 2.0f, 5.0f, 1.0f};
    camera.motion = {camera.world_from_camera};
    camera.motion[0][3] = {1.0f, 2.0f, 6.0f, 1.0f};
    const Vec3 center(1.0f, 0.5f, 0.0f);
    const auto near = [](const Vec4& a, const Vec4& b) { return glm::distance(a, b) < 1e-5f; };
    constexpr float quarter = 1.5707964f;
    const CameraDesc side = orbited(camera, center, quarter);
    CHECK(near(side.world_from_camera[3], {6.0f, 2.0f, 0.0f, 1.0f}));
    CHECK(near(side.world_from_camera[2], {1.0f, 0.0f, 0.0f, 0.0f}));  // it looks to -x
    CHECK(near(side.world_from_camera[1], {0.0f, 1.0f, 0.0f, 0.0f}));
    CHECK(near(side.motion.at(0)[3], {7.0f, 2.0f, 0.0f, 1.0f}));
    CHECK(orbited(camera, center, 0.0f).world_from_camera == camera.world_from_camera);
    const CameraDesc back = orbited(orbited(side, center, quarter), center, 2.0f * quarter);
    CHECK(near(back.world_from_camera[3], camera.world_from_camera[3]));
}

}  // namespace bdpt::framing_test
