#include "scene/open_edges.h"

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <string>

namespace bdpt::test::open_edges_test {
using test::SceneBuilder;

TEST_CASE("closed meshes have no open edges, whatever their seams", "[bodies]")
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, test::glass(0.0f));
    CHECK(count_open_edges(builder.desc.meshes.back()) == 0);
    // The seam of texture coordinates and the poles have several vertices at one place.
    MeshDesc sphere = builder.desc.meshes[static_cast<std::size_t>(builder.sphere_mesh(12))];
    for (Vec3& p : sphere.positions) {
        p = glm::round(p * 1024.0f) / 1024.0f;
    }
    CHECK(count_open_edges(sphere) == 0);
}

TEST_CASE("holes and faces that look the other way are open edges", "[bodies]")
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, test::glass(0.0f));
    MeshDesc cube = builder.desc.meshes.back();
    std::swap(cube.triangles[5].x, cube.triangles[5].y);
    CHECK(count_open_edges(cube) == 3);
    cube.triangles.erase(cube.triangles.begin() + 5);
    CHECK(count_open_edges(cube) == 3);
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, test::glass(0.0f));
    CHECK(count_open_edges(builder.desc.meshes.back()) == 4);
}

TEST_CASE("open bodies are told, sheets and walls are not", "[bodies]")
{
    const auto warnings = [](const MaterialDesc& material) {
        SceneBuilder builder;
        builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, material);
        builder.desc.meshes.back().name = "pane";
        builder.place(MeshId{0}, material, Mat4(1.0f));
        builder.light(PointLightDesc{.position = {0.0f, 5.0f, 0.0f}});
        return World(std::move(builder.desc)).warnings();
    };
    const auto told = warnings(test::glass(0.2f));
    REQUIRE(told.size() == 1);  // once for a mesh
    CHECK(told[0].find("mesh 0 \"pane\": 4 edges are open") == 0);
    CHECK(warnings(test::thin_glass(0.2f)).empty());
    CHECK(warnings(test::lambertian(Rgb(0.5f))).empty());
}

}  // namespace bdpt::test::open_edges_test
