#include <bdpt/error.h>
#include <bdpt/scene.h>
#include <bdpt/tools/intrinsics.h>
#include <bdpt/tools/pixel_hits.h>
#include <bdpt/tools/scene_builder.h>

#include "catch.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::pixel_hits_test {
namespace {

constexpr int width = 32;
constexpr int height = 24;

/// A wall at z = -4, and two boxes of the same name before it at x = `left` and x = 1.
SceneDesc stage(float left)
{
    SceneBuilder builder;
    MaterialDesc grey;
    grey.name = "grey";
    const MaterialId material = builder.add(grey);
    builder
        .place(builder.add(quad_mesh({-20, -20, -4}, {20, -20, -4}, {20, 20, -4}, {-20, 20, -4})),
               material)
        .name = "wall";
    const MeshId box =
        builder.add(quad_mesh({-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}));
    for (const float x : {left, 1.0f}) {
        Mat4 place(1.0f);
        place[3] = {x, 0.0f, -2.0f, 1.0f};
        builder.place(box, material, place).name = "box";
    }
    builder.add(PointLightDesc{.position = {0.0f, 4.0f, 0.0f}, .intensity = Rgb(1.0f)});
    return builder.take();
}

CameraDesc camera_at(float x)
{
    CameraDesc camera;
    camera.world_from_camera[3] = {x, 0.0f, 0.0f, 1.0f};
    camera.vertical_fov = 1.2f;
    return camera;
}

/// Returns where a pinhole camera at the origin, which looks along -z, shows a point [pixels].
Vec2 projected(const CameraDesc& camera, Vec3 point)
{
    const Vec3 local = point - Vec3(camera.world_from_camera[3]);
    const float fy = 0.5f * height / std::tan(0.5f * camera.vertical_fov);
    const float fx = fy / camera.pixel_aspect;
    return {width * (0.5f - camera.shift.x) - fx * local.x / local.z,
            height * (0.5f + camera.shift.y) + fy * local.y / local.z};
}

float distance_to_middle(Vec2 raster, std::size_t pixel)
{
    const Vec2 middle(static_cast<float>(pixel % width) + 0.5f,
                      static_cast<float>(pixel / width) + 0.5f);
    return glm::distance(raster, middle);
}

}  // namespace

TEST_CASE("pixel hits appear in the middles of their pixels", "[pixel_hits]")
{
    const Scene scene(stage(-1.0f));
    CameraDesc camera = camera_at(0.3f);
    SECTION("a plain camera") {}
    SECTION("the intrinsics of a real one")
    {
        set_intrinsics(camera, {.fx = 17.0, .fy = 22.0, .cx = 3.0, .cy = 7.0}, width, height);
        const Intrinsics values = intrinsics(camera, width, height);
        CHECK(values.fx == Approx(17.0).epsilon(1e-5));
        CHECK(values.fy == Approx(22.0).epsilon(1e-5));
        CHECK(values.cx == Approx(3.0).epsilon(1e-5));
        CHECK(values.cy == Approx(7.0).epsilon(1e-5));
    }
    SECTION("a finite lens is a pinhole")
    {
        camera.lens_radius = 0.5f;
        camera.focus_distance = 2.0f;
    }
    const PixelHits seen = pixel_hits(scene, camera, width, height);
    REQUIRE(seen.hits.size() == std::size_t{width} * height);
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        REQUIRE(seen.hits[i]);
        CHECK(distance_to_middle(projected(camera, seen.hits[i]->position), i) < 1e-3f);
    }
}

TEST_CASE("masks number the things that pixels show", "[pixel_hits]")
{
    const Scene scene(stage(-1.0f));
    const PixelHits seen = pixel_hits(scene, camera_at(0.0f), width, height);
    const IdNumbers of_objects = id_numbers(scene, IdKind::object);
    REQUIRE(of_objects.names == std::vector<std::string>{"", "box", "wall"});
    CHECK(of_objects.of_instances == std::vector<std::uint32_t>{2, 1, 1});
    const IdNumbers of_materials = id_numbers(scene, IdKind::material);
    REQUIRE(of_materials.names == std::vector<std::string>{"", "grey"});
    const IdNumbers of_instances = id_numbers(scene, IdKind::instance);
    REQUIRE(of_instances.names.size() == 4);
    const std::vector<std::uint32_t> objects = id_mask(seen, of_objects);
    const std::vector<std::uint32_t> materials = id_mask(seen, of_materials);
    const std::vector<std::uint32_t> instances = id_mask(seen, of_instances);
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        const std::uint32_t instance = seen.hits[i]->instance.value();
        CHECK(objects[i] == (instance == 0 ? 2u : 1u));
        CHECK(materials[i] == 1u);
    }
    const auto number_at = [&](int x) {
        return instances[static_cast<std::size_t>(height / 2 * width + x)];
    };
    CHECK(number_at(8) != number_at(24));  // two boxes
    CHECK(number_at(8) != number_at(0));
}

TEST_CASE("nothing is numbered 0", "[pixel_hits]")
{
    SceneDesc desc = stage(-1.0f);
    desc.instances.erase(desc.instances.begin());  // the wall
    const Scene scene(desc);
    const PixelHits seen = pixel_hits(scene, camera_at(0.0f), width, height);
    CHECK_FALSE(seen.at(0, 0));
    CHECK(id_mask(seen, id_numbers(scene, IdKind::object)).front() == 0);
}

TEST_CASE("optical flow is where a point goes, as camera and things move", "[pixel_hits]")
{
    const Scene scene(stage(-1.0f));
    const Scene later(stage(-0.6f));
    const CameraDesc first = camera_at(0.0f);
    const CameraDesc second = camera_at(0.25f);
    const PixelHits seen = pixel_hits(scene, first, width, height);
    const std::vector<PixelFlow> flow = optical_flow(seen, later, second);
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
        const SurfaceHit& hit = *seen.hits[i];
        const Vec3 moved = hit.position + Vec3(hit.instance == 1u ? 0.4f : 0.0f, 0.0f, 0.0f);
        const Vec2 expected = projected(second, moved) - projected(first, hit.position);
        CHECK(glm::distance(flow[i].motion, expected) < 1e-2f);
        const Vec2 raster = projected(second, moved);
        const bool inside = raster.x >= 0.0f && raster.x <= width;
        const auto met = first_hit(later, Vec3(second.world_from_camera[3]),
                                   moved - Vec3(second.world_from_camera[3]));
        const bool is_same = met && met->instance == hit.instance;
        CHECK(flow[i].is_visible == (inside && is_same));
        hidden += flow[i].is_visible ? 0 : 1;
    }
    CHECK(hidden > 10);
    CHECK(hidden < flow.size() / 2);
}

TEST_CASE("optical flow follows meshes that deform", "[pixel_hits]")
{
    const Scene scene(stage(-1.0f));
    SceneDesc desc = stage(-1.0f);
    for (Vec3& position : desc.meshes[1].positions) {
        position.y *= 1.5f;
    }
    const Scene later(desc);
    const CameraDesc camera = camera_at(0.0f);
    const PixelHits seen = pixel_hits(scene, camera, width, height);
    const std::vector<PixelFlow> flow = optical_flow(seen, later, camera);
    for (std::size_t i = 0; i < flow.size(); ++i) {
        const SurfaceHit& hit = *seen.hits[i];
        const Vec3 stretched =
            hit.instance == 0u ? hit.position : hit.position * Vec3(1.0f, 1.5f, 1.0f);
        const Vec2 expected = projected(camera, stretched) - projected(camera, hit.position);
        CHECK(glm::distance(flow[i].motion, expected) < 1e-2f);
    }
}

TEST_CASE("an image without pixels has no hits", "[pixel_hits]")
{
    const Scene scene(stage(-1.0f));
    CHECK_THROWS_AS(pixel_hits(scene, camera_at(0.0f), 0, 4), Error);
}

}  // namespace bdpt::pixel_hits_test
