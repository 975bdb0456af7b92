#include "geometry/placed_mesh.h"

#include "catch.hpp"
#include "scene_builder.h"

#include <glm/geometric.hpp>

namespace bdpt::placed_mesh_test {
namespace {

/// A square in the plane z = 0 that looks along +z, with the image upright: u to the right (+x)
/// and v downwards (-y).
MeshDesc upright()
{
    MeshDesc mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// Where the up direction of a normal map points.
Vec3 bitangent(const PlacedMesh& mesh)
{
    const Vec4 t = mesh.tangent(0, {0.3f, 0.3f}, 0, 0.0f);
    const Vec3 n = normalize(mesh.area_normal(0, 0.0f));
    return normalize(cross(n, Vec3(t)) * t.w);
}

}  // namespace

TEST_CASE("derived tangents follow u, and the bitangent points up in the image", "[geometry]")
{
    const MeshDesc mesh = upright();
    const PlacedMesh plain(mesh, Mat4(1.0f));
    CHECK(normalize(Vec3(plain.tangent(0, {0.3f, 0.3f}, 0, 0.0f))).x == Approx(1.0f));
    CHECK(bitangent(plain).y == Approx(1.0f));
    CHECK(plain.tangent(0, {0.3f, 0.3f}, 1, 0.0f) == Vec4(0.0f));  // no coordinates in set 1

    const PlacedMesh mirrored(mesh, glm::scale(Mat4(1.0f), Vec3(-1.0f, 1.0f, 1.0f)));
    CHECK(normalize(Vec3(mirrored.tangent(0, {0.3f, 0.3f}, 0, 0.0f))).x == Approx(-1.0f));
    CHECK(bitangent(mirrored).y == Approx(1.0f));

    MeshDesc flipped = mesh;
    for (Vec2& uv : flipped.uvs[0]) {
        uv.x = 1.0f - uv.x;
    }
    const PlacedMesh mirrored_image(flipped, Mat4(1.0f));
    CHECK(normalize(Vec3(mirrored_image.tangent(0, {0.3f, 0.3f}, 0, 0.0f))).x == Approx(-1.0f));
    CHECK(bitangent(mirrored_image).y == Approx(1.0f));
}

TEST_CASE("a mesh's own tangents are placed, with their handedness", "[geometry]")
{
    MeshDesc mesh = upright();
    mesh.tangents.assign(4, Vec4(1.0f, 0.0f, 0.0f, 1.0f));
    CHECK(bitangent(PlacedMesh(mesh, Mat4(1.0f))).y == Approx(1.0f));
    const PlacedMesh mirrored(mesh, glm::scale(Mat4(1.0f), Vec3(-1.0f, 1.0f, 1.0f)));
    CHECK(bitangent(mirrored).y == Approx(1.0f));
}

TEST_CASE("normals of stretched meshes stay at right angles to the surface", "[geometry]")
{
    test::SceneBuilder builder;
    const MeshId id = builder.sphere_mesh(64);
    const MeshDesc& mesh = builder.desc.meshes[static_cast<std::size_t>(id)];
    for (const Vec3 scale : {Vec3(1, 4, 1), Vec3(-2, 1, 0.5f)}) {
        const PlacedMesh placed(mesh, glm::scale(Mat4(1.0f), scale));
        for (std::uint32_t t = 0; t < placed.triangle_count(); t += 37) {
            const Vec2 middle(1.0f / 3.0f);
            const Vec3 facet = normalize(placed.area_normal(t, 0.0f));
            CHECK(dot(placed.shading_normal(t, middle, 0.0f), facet) > 0.95f);
            CHECK(dot(facet, placed.point(t, middle, 0.0f).p) > 0.0f);  // outwards
        }
    }
}

TEST_CASE("attributes are interpolated, and absent ones have their defaults", "[geometry]")
{
    MeshDesc mesh = upright();
    const PlacedMesh placed(mesh, Mat4(1.0f));
    const auto uv = placed.uv(0, {0.5f, 0.25f});
    CHECK(uv[0].x == Approx(0.75f));
    CHECK(uv[0].y == Approx(0.75f));
    CHECK(uv[1] == Vec2(0.0f));
    CHECK(placed.color(0, {0.5f, 0.25f}) == Vec4(1.0f));
    CHECK(placed.shading_normal(0, {0.5f, 0.25f}, 0.0f) == Vec3(0.0f));
    mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}};
    CHECK(placed.color(0, {0.5f, 0.25f}).g == Approx(0.5f));
}

TEST_CASE("a pixel covers texture coordinates as the triangle is placed", "[geometry]")
{
    // Skewed in the plane and in the image: 4 m of x are 1 of u, 1 m of y is 2 of v.
    MeshDesc mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {0.25f, 2}};
    mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {0, 0, 1}};
    const PlacedMesh doubled(mesh, glm::scale(Mat4(1.0f), Vec3(2.0f)));
    for (const std::uint32_t triangle : {0U, 1U}) {
        const UvSteps steps = doubled.uv_footprint(triangle, 0.1f, 0.0f)[0];
        // The metric of the footprint does not depend on the corner that it is worked out from.
        const Vec2 u(steps.along.x, steps.across.x);
        const Vec2 v(steps.along.y, steps.across.y);
        CHECK(dot(u, u) == Approx(0.1 * 0.1 / 64.0));
        CHECK(dot(v, v) == Approx(0.1 * 0.1));
        CHECK(dot(u, v) == Approx(0.0).margin(1e-7));
    }
    // While it grows, a pixel covers less and less of it.
    InstanceDesc growing;
    growing.motion = {glm::scale(Mat4(1.0f), Vec3(2.0f))};
    const PlacedMesh grown(mesh, growing);
    for (const float time : {0.0f, 0.5f, 1.0f}) {
        CHECK(grown.uv_footprint(0, 0.1f, time)[0].along.x ==
              Approx(0.1f / (4.0f * (1.0f + time))));
    }
    CHECK(doubled.uv_footprint(0, 0.1f, 0.0f)[1].along == Vec2(0.0f));   // no coordinates in set 1
    CHECK(doubled.uv_footprint(2, 0.1f, 0.0f)[0].across == Vec2(0.0f));  // no area
}

}  // namespace bdpt::placed_mesh_test
