#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>
#include <bdpt/tools/scene_builder.h>

#include "catch.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace bdpt::scene_builder_test {
namespace {

/// By the divergence theorem; positive when the triangles are seen from outside.
double volume_of(const MeshDesc& mesh)
{
    double sum = 0.0;
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]);
        const glm::dvec3 b(mesh.positions[triangle.y]);
        const glm::dvec3 c(mesh.positions[triangle.z]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

}  // namespace

TEST_CASE("shapes of the scene builder are closed and seen from outside", "[builder]")
{
    CHECK(volume_of(box_mesh({1, 2, 3}, {2, 4, 6})) == Approx(6.0));
    CHECK(volume_of(sphere_mesh(2.0f, 256)) == Approx(4.0 / 3.0 * 3.14159265 * 8.0).epsilon(1e-3));
    const MeshDesc sphere = sphere_mesh(2.0f, 16);
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        CHECK(glm::length(sphere.normals[i]) == Approx(1.0f).margin(1e-6));
        CHECK(glm::length(sphere.positions[i]) == Approx(2.0f).margin(1e-6));
    }
    const MeshDesc quad = quad_mesh({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
    for (const auto& triangle : quad.triangles) {
        const Vec3 a = quad.positions[triangle.x];
        CHECK(glm::cross(quad.positions[triangle.y] - a, quad.positions[triangle.z] - a).z > 0.0f);
    }
    for (const unsigned segments : {0U, 3U, 4097U}) {
        CHECK_THROWS_AS(sphere_mesh(1.0f, segments), Error);
    }
    CHECK_THROWS_AS(sphere_mesh(0.0f), Error);
    CHECK_THROWS_AS(sphere_mesh(std::numeric_limits<float>::infinity()), Error);
}

TEST_CASE("a camera looks at its target, upright", "[builder]")
{
    for (const Vec3 to : {Vec3(1, 2, -5), Vec3(0, 9, 0), Vec3(0, -9, 0), Vec3(3, 0, 4)}) {
        const Vec3 from(0.0f, 1.0f, 0.0f);
        const CameraDesc camera = look_at(from, to, 0.5f);
        const Vec3 forward = -Vec3(camera.world_from_camera[2]);
        CHECK(glm::distance(forward, glm::normalize(to - from)) < 1e-6f);
        CHECK(Vec3(camera.world_from_camera[3]) == from);
        CHECK(std::abs(camera.world_from_camera[0].y) < 1e-6f);  // no roll
        CHECK(camera.world_from_camera[1].y >= -1e-6f);
        CHECK(glm::determinant(Mat3(camera.world_from_camera)) == Approx(1.0f));
        CHECK(camera.vertical_fov == 0.5f);
    }
    CHECK_THROWS_AS(look_at(Vec3(1.0f), Vec3(1.0f)), Error);
}

TEST_CASE("a scene from the builder renders: a white furnace", "[builder]")
{
    SceneBuilder builder;
    MaterialDesc white;
    white.metallic = 0.0f;
    white.specular = 0.0f;
    const MaterialId material = builder.add(std::move(white));
    const MeshId ball = builder.add(sphere_mesh(0.5f));
    builder.place(ball, material).name = "left";
    Mat4 moved(1.0f);
    moved[3] = {1.5f, 0.0f, 0.0f, 1.0f};
    builder.place(ball, material, moved).name = "right";
    builder.add(EnvironmentLightDesc{
        .radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(0.5f, 1.0f, 2.0f)}}});
    CHECK(builder.desc().instances.size() == 2);
    const Scene scene(builder.take());
    CHECK(builder.desc().instances.empty());
    CHECK(scene.description().instances[1].name == "right");
    RenderOptions options;
    options.film.width = 24;
    options.film.height = 16;
    options.sampling.samples = {0, 16};
    options.transport.max_depth = 64;
    const Image image =
        render(scene, look_at({0.75f, 1.0f, 4.0f}, {0.75f, 0.0f, 0.0f}), options).film.develop();
    Rgb sum(0.0f);
    for (const Rgb& pixel : image.pixels) {
        CHECK(pixel.g == Approx(1.0f).epsilon(0.25));
        sum += pixel / static_cast<float>(image.pixels.size());
    }
    CHECK(sum.r == Approx(0.5f).epsilon(0.005));
    CHECK(sum.g == Approx(1.0f).epsilon(0.005));
    CHECK(sum.b == Approx(2.0f).epsilon(0.005));
}

TEST_CASE("the builder refuses what it has not made", "[builder]")
{
    SceneBuilder builder;
    const MeshId mesh = builder.add(box_mesh(Vec3(0.0f), Vec3(1.0f)));
    CHECK_THROWS_WITH(builder.place(mesh, MaterialId{0}), "scene builder: there is no material 0");
    const MaterialId material = builder.add(MaterialDesc{});
    CHECK_THROWS_WITH(builder.place(MeshId{1}, material), "scene builder: there is no mesh 1");
    CHECK(builder.desc().instances.empty());
}

}  // namespace bdpt::scene_builder_test
