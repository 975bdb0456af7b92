#include <bdpt/framing.h>
#include <bdpt/tools/ray_query.h>

#include "camera/camera.h"
#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

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

/// The part of the image, from 0 to 1 in both directions, that the vertices of a scene take.
struct Extent {
    Vec2 min{1e9f};
    Vec2 max{-1e9f};
    [[nodiscard]] Vec2 size() const { return max - min; }
};

Extent extent_of(const SceneDesc& desc, const CameraDesc& view, float aspect)
{
    const Vec2 film(1000.0f * aspect, 1000.0f);
    const Camera camera(view, static_cast<int>(film.x), static_cast<int>(film.y),
                        {.min = Vec2(-1e6f), .max = Vec2(1e6f)});
    Extent extent;
    for (const InstanceDesc& instance : desc.instances) {
        for (const Vec3 p : desc.meshes.at(static_cast<std::size_t>(instance.mesh)).positions) {
            const Vec3 world(instance.world_from_object * Vec4(p, 1.0f));
            const auto seen = camera.sample_lens(world, Vec2(0.5f));
            REQUIRE(seen);
            extent.min = min(extent.min, seen->raster / film);
            extent.max = max(extent.max, seen->raster / film);
        }
    }
    return extent;
}

/// A closed ring of tunnel with bumpy walls, 16 m wide, whose front is inside.
SceneDesc bumpy_tunnel()
{
    constexpr int around = 96;
    constexpr int sides = 32;
    constexpr float turn = 6.2831853f;
    MeshDesc mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < sides; ++j) {
            const float u = turn * static_cast<float>(i) / around;
            const float v = turn * static_cast<float>(j) / sides;
            const float bumps = 0.3f * std::sin(5.0f * u + v) +
                                0.2f * std::sin(11.0f * u - 3.0f * v) +
                                0.1f * std::sin(23.0f * u + 5.0f * v);
            const float radius = 1.6f * (1.0f + bumps);
            const float away = 8.0f * (1.0f + 0.3f * std::sin(2.0f * u)) + radius * std::cos(v);
            mesh.positions.emplace_back(away * std::cos(u), radius * std::sin(v),
                                        away * std::sin(u));
        }
    }
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < sides; ++j) {
            const auto at = [&](int du, int dv) {
                return static_cast<std::uint32_t>((i + du) % around * sides + (j + dv) % sides);
            };
            mesh.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
            mesh.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
        }
    }
    SceneBuilder builder;
    builder.place(builder.add_mesh(std::move(mesh)), test::lambertian(Rgb(0.5f)), Mat4(1.0f));
    return std::move(builder.desc);
}

/// A flat board that stands askew, 4 m wide and 1 m high, far from the origin, and a ball.
SceneDesc board_and_ball()
{
    SceneBuilder builder;
    const MaterialDesc grey = test::lambertian(Rgb(0.5f));
    const Vec3 at(30.0f, 5.0f, -8.0f);
    builder.quad(at, at + Vec3(3.5f, 0.0f, 2.0f), at + Vec3(3.5f, 1.0f, 2.0f),
                 at + Vec3(0.0f, 1.0f, 0.0f), grey);
    builder.sphere(at + Vec3(1.0f, 0.5f, 1.0f), 0.4f, grey);
    return std::move(builder.desc);
}

}  // namespace

TEST_CASE("an object fills the image but for the margin, from all sides", "[framing]")
{
    const SceneDesc desc = board_and_ball();
    const Scene scene(desc);
    constexpr float quarter = 1.5707964f;
    // Catch2 2 keeps references to all values if the first is no temporary.
    const ViewDirection direction = GENERATE(
        ViewDirection(three_quarter_view), ViewDirection{0.0f, 0.0f}, ViewDirection{quarter, 0.0f},
        ViewDirection{0.0f, quarter}, ViewDirection{0.4f, -quarter}, ViewDirection{-2.0f, 0.7f});
    const float aspect = GENERATE(0.5f, 1.0f, 2.0f);
    const float margin = GENERATE(0.0f, 0.1f, 0.3f);
    const Projection projection = GENERATE(Projection::perspective, Projection::orthographic);
    CAPTURE(direction.azimuth, direction.elevation, aspect, margin);
    const FramedView view = frame_scene(
        scene, aspect, {.direction = direction, .margin = margin, .projection = projection});
    CHECK_FALSE(view.enclosed);
    const Extent extent = extent_of(desc, view.camera, aspect);
    const float used = 1.0f - 2.0f * margin;
    CHECK(std::max(extent.size().x, extent.size().y) == Approx(used).margin(2e-4));
    for (int axis = 0; axis < 2; ++axis) {
        CHECK(extent.min[axis] >= margin - 2e-4f);
        CHECK(extent.max[axis] <= 1.0f - margin + 2e-4f);
        CHECK(extent.min[axis] + extent.max[axis] == Approx(1.0f).margin(4e-3));  // in the middle
    }
}

TEST_CASE("a view by angles stands where they say, upright", "[framing]")
{
    const Scene scene(board_and_ball());
    constexpr float quarter = 1.5707964f;
    const auto axes = [&](float azimuth, float elevation) {
        return frame_scene(scene, 1.0f, {.direction = ViewDirection{azimuth, elevation}})
            .camera.world_from_camera;
    };
    const auto near = [](const Vec4& a, Vec3 b) { return glm::distance(Vec3(a), b) < 1e-5f; };
    CHECK(near(axes(0.0f, 0.0f)[2], {0.0f, 0.0f, 1.0f}));
    CHECK(near(axes(0.0f, 0.0f)[0], {1.0f, 0.0f, 0.0f}));
    CHECK(near(axes(quarter, 0.0f)[2], {1.0f, 0.0f, 0.0f}));
    CHECK(near(axes(quarter, 0.0f)[1], {0.0f, 1.0f, 0.0f}));
    // From above the front is below, from below it is above.
    CHECK(near(axes(0.0f, quarter)[2], {0.0f, 1.0f, 0.0f}));
    CHECK(near(axes(0.0f, quarter)[1], {0.0f, 0.0f, -1.0f}));
    CHECK(near(axes(0.0f, -quarter)[1], {0.0f, 0.0f, 1.0f}));
}

TEST_CASE("flat and long things are seen from their large side", "[framing]")
{
    struct Case {
        Vec3 extent;
        ViewDirection direction;  // [degrees]
    };
    for (const Case& one : {Case{{2.0f, 2.0f, 2.0f}, {35.0f, 20.0f}},  // a box
                            Case{{1.8f, 1.4f, 4.5f}, {35.0f, 20.0f}},  // a car
                            Case{{3.0f, 2.0f, 0.4f}, {15.0f, 8.0f}},   // a picture
                            Case{{0.4f, 2.0f, 3.0f}, {75.0f, 8.0f}},   // one on another wall
                            Case{{9.0f, 0.2f, 9.0f}, {35.0f, 45.0f}},  // a floor
                            Case{{9.0f, 2.0f, 2.0f}, {15.0f, 20.0f}},  // a row
                            Case{{2.0f, 2.0f, 9.0f}, {75.0f, 20.0f}},  // one of another direction
                            Case{{9.0f, 0.1f, 2.0f}, {15.0f, 45.0f}}}) {  // a plank
        SceneBuilder builder;
        const Vec3 e = one.extent;
        builder.quad({}, {e.x, 0.0f, 0.0f}, e, {0.0f, e.y, e.z}, test::lambertian(Rgb(0.5f)));
        const Scene scene(std::move(builder.desc));
        CAPTURE(e.x, e.y, e.z);
        const Vec3 back = -forward(frame_scene(scene, 1.5f));
        constexpr float degree = 0.017453293f;
        CHECK(std::atan2(back.x, back.z) == Approx(one.direction.azimuth * degree));
        CHECK(std::asin(back.y) == Approx(one.direction.elevation * degree));
        // A direction that is asked for counts.
        const FrameOptions asked{.direction = three_quarter_view};
        CHECK(-forward(frame_scene(scene, 1.5f, asked)).y ==
              Approx(std::sin(three_quarter_view.elevation)));
    }
}

TEST_CASE("another field of view changes the distance, not the size in the image", "[framing]")
{
    const SceneDesc desc = board_and_ball();
    const Scene scene(desc);
    const CameraDesc wide = frame_scene(scene, 1.5f, {.vertical_fov = 1.5f}).camera;
    const CameraDesc narrow = frame_scene(scene, 1.5f, {.vertical_fov = 0.1f}).camera;
    CHECK(wide.vertical_fov == 1.5f);
    for (const CameraDesc& camera : {wide, narrow}) {
        const Vec2 size = extent_of(desc, camera, 1.5f).size();
        CHECK(std::max(size.x, size.y) == Approx(0.8f).margin(2e-4));
    }
    const Vec3 middle = 0.5f * (scene.bounds().min + scene.bounds().max);
    CHECK(glm::distance(Vec3(narrow.world_from_camera[3]), middle) >
          10.0f * glm::distance(Vec3(wide.world_from_camera[3]), middle));
}

TEST_CASE("a turntable keeps its margin in all views, and comes up to it in one", "[framing]")
{
    const SceneDesc desc = board_and_ball();
    const Scene scene(desc);
    const Bounds bounds = scene.bounds();
    const Projection projection = GENERATE(Projection::perspective, Projection::orthographic);
    const CameraDesc first =
        frame_scene(scene, 1.5f, {.projection = projection, .whole_turn = true}).camera;
    float widest = 0.0f;
    for (int i = 0; i < 360; ++i) {
        const CameraDesc camera =
            orbited(first, 0.5f * (bounds.min + bounds.max), static_cast<float>(i) * 0.017453292f);
        const Extent extent = extent_of(desc, camera, 1.5f);
        for (int axis = 0; axis < 2; ++axis) {
            CHECK(extent.min[axis] >= 0.1f - 2e-4f);
            CHECK(extent.max[axis] <= 0.9f + 2e-4f);
        }
        widest = std::max({widest, 0.5f - extent.min.x, extent.max.x - 0.5f, 0.5f - extent.min.y,
                           extent.max.y - 0.5f});
    }
    CHECK(widest == Approx(0.4f).margin(1e-3));
}

TEST_CASE("what moves while the shutter is open is framed on all of its way", "[framing]")
{
    SceneDesc desc = board_and_ball();
    Mat4 later(1.0f);
    later[3] = {0.0f, 3.0f, 0.0f, 1.0f};
    desc.instances.front().motion = {later};
    const FramedView view = frame_scene(Scene(desc), 1.0f, {.direction = ViewDirection{}});
    desc.instances.front().motion.clear();
    SceneDesc end = desc;
    end.instances.front().world_from_object = later;
    const float top = extent_of(end, view.camera, 1.0f).min.y;
    const float bottom = extent_of(desc, view.camera, 1.0f).max.y;
    CHECK(bottom - top == Approx(0.8f).margin(2e-4));
}

TEST_CASE("an object is framed whole, from the front, slightly above", "[framing]")
{
    for (const float size : {1e-3f, 1.0f, 1e4f}) {
        SceneBuilder builder;
        builder.sphere(Vec3(5.0f, 1.0f, -2.0f) * size, size, test::lambertian(Rgb(0.5f)));
        const Scene scene(builder.desc);
        for (const float aspect : {0.5f, 1.0f, 16.0f / 9.0f}) {
            const FramedView view = frame_scene(scene, aspect);
            CHECK_FALSE(view.enclosed);
            const Extent extent = extent_of(builder.desc, view.camera, aspect);
            for (int axis = 0; axis < 2; ++axis) {
                CHECK(extent.min[axis] >= 0.1f - 2e-4f);
                CHECK(extent.max[axis] <= 0.9f + 2e-4f);
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

TEST_CASE("a cave is seen from where its lamp shines", "[framing]")
{
    const Scene scene(bumpy_tunnel());
    const FramedView view = frame_scene(scene, 1.5f);
    CHECK(view.inside);
    CHECK(view.enclosed);
    const CameraDesc& camera = view.camera;
    int lit = 0;
    int deep = 0;
    constexpr int side = 16;
    for (int i = 0; i < side * side; ++i) {
        const float x = (static_cast<float>(i % side) + 0.5f) / side - 0.5f;
        const float y = (static_cast<float>(i / side) + 0.5f) / side - 0.5f;
        const Vec3 direction = normalize(Mat3(camera.world_from_camera) * Vec3(x, y, -1.0f));
        const auto hit = first_hit(scene, eye(view), direction);
        REQUIRE(hit);
        const Vec3 before = hit->position - 1e-3f * direction;
        lit += is_visible(scene, before, view.lamp_position) ? 1 : 0;
        deep += hit->distance > 1.0f ? 1 : 0;  // the tunnel is 3 m wide
    }
    CHECK(lit > side * side / 3);
    CHECK(deep > side * side / 2);

    SECTION("whatever the aspect ratio and the field of view of the image")
    {
        for (const float aspect : {0.4f, 1.0f, 3.0f}) {
            const FramedView other = frame_scene(scene, aspect, {.vertical_fov = 0.5f});
            CHECK(other.camera.world_from_camera == camera.world_from_camera);
            CHECK(other.lamp_position == view.lamp_position);
            CHECK(other.camera.vertical_fov == 0.5f);
        }
    }
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
