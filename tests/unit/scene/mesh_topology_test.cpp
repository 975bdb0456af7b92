#include "scene/contacts/mesh_topology.h"

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <string>

namespace bdpt::test::mesh_topology_test {
using test::SceneBuilder;

TEST_CASE("closed meshes have no open edges, whatever their seams", "[bodies]")
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, test::glass(0.0f));
    CHECK(find_shells(builder.desc.meshes.back()).open_edges == 0);
    // The seam of texture coordinates and the poles have several vertices at one place.
    MeshDesc sphere = builder.desc.meshes[static_cast<std::size_t>(builder.sphere_mesh(12))];
    for (Vec3& p : sphere.positions) {
        p = glm::round(p * 1024.0f) / 1024.0f;
    }
    CHECK(find_shells(sphere).open_edges == 0);
}

TEST_CASE("holes and faces that look the other way are open edges", "[bodies]")
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, test::glass(0.0f));
    MeshDesc cube = builder.desc.meshes.back();
    std::swap(cube.triangles[5].x, cube.triangles[5].y);
    CHECK(find_shells(cube).open_edges == 3);
    cube.triangles.erase(cube.triangles.begin() + 5);
    CHECK(find_shells(cube).open_edges == 3);
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, test::glass(0.0f));
    CHECK(find_shells(builder.desc.meshes.back()).open_edges == 4);
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

TEST_CASE("boxes that touch in one mesh are shells of their own", "[bodies]")
{
    const MeshDesc lower = box_mesh({-1, 0, -1}, {1, 1, 1});
    const MeshDesc upper = box_mesh({-1, 1, -1}, {1, 2, 1});
    MeshDesc both = lower;
    for (const UVec3& triangle : upper.triangles) {
        both.triangles.push_back(triangle + static_cast<unsigned>(lower.positions.size()));
    }
    both.positions.insert(both.positions.end(), upper.positions.begin(), upper.positions.end());
    const Shells shells = find_shells(both);
    REQUIRE(shells.are_closed.size() == 2);
    CHECK(shells.are_closed[0]);
    CHECK(shells.are_closed[1]);
    for (std::size_t t = 0; t < both.triangles.size(); ++t) {
        CHECK((shells.of_triangles[t] == shells.of_triangles[0]) == (t < lower.triangles.size()));
    }
    both.triangles.pop_back();
    const Shells opened = find_shells(both);
    CHECK(opened.are_closed[opened.of_triangles[0]]);
    CHECK_FALSE(opened.are_closed[opened.of_triangles.back()]);
}

}  // namespace bdpt::test::mesh_topology_test
