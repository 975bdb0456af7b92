#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt::test::deformation_test {
using namespace bdpt::io;

namespace {

nlohmann::json& primitive_of(GltfFixture& fixture)
{
    return fixture.json["meshes"][0]["primitives"][0];
}

/// A triangle with normals and tangents and two morph targets: 0 moves positions, 1 all of them.
GltfFixture with_targets()
{
    GltfFixture fixture = GltfFixture::triangle();
    const int normals =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    const int tangents = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}));
    const int up =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 2, 0, 0, 4}));
    const int tilt =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}));
    const int turn =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}));
    primitive_of(fixture)["attributes"]["NORMAL"] = normals;
    primitive_of(fixture)["attributes"]["TANGENT"] = tangents;
    primitive_of(fixture)["targets"] = {{{"POSITION", up}},
                                        {{"POSITION", up}, {"NORMAL", tilt}, {"TANGENT", turn}}};
    return fixture;
}

/// A triangle that hangs on two joints, nodes 1 and 2, by vertex: the first, the second, both.
GltfFixture with_skin()
{
    GltfFixture fixture = GltfFixture::triangle();
    auto& attributes = primitive_of(fixture)["attributes"];
    attributes["NORMAL"] =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    attributes["JOINTS_0"] = fixture.add_accessor(
        u8, "VEC4", 3, bytes_of<std::uint8_t>({0, 9, 9, 9, 1, 0, 0, 0, 0, 1, 0, 0}));
    attributes["WEIGHTS_0"] = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0}));
    fixture.json["nodes"][0]["skin"] = 0;
    fixture.json["nodes"][0]["translation"] = {100, 0, 0};  // counts for nothing
    fixture.json["nodes"].push_back({{"translation", {1, 0, 0}}, {"children", {2}}});
    fixture.json["nodes"].push_back({{"translation", {0, 8, 0}}});
    fixture.json["scenes"][0]["nodes"] = {0, 1};
    fixture.json["skins"] = {{{"joints", {1, 2}}}};
    return fixture;
}

/// Inverse bind matrices: of joint 0 the identity, of joint 1 a move down by 8.
void bind(GltfFixture& fixture, float scale = 1.0f)
{
    fixture.json["skins"][0]["inverseBindMatrices"] = fixture.add_accessor(
        f32, "MAT4", 2, bytes_of<float>({1, 0, 0, 0, 0, 1,     0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                         1, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1, 0, 0, -8, 0, 1}));
}

const MeshDesc& only_mesh(const LoadedScene& loaded)
{
    REQUIRE(loaded.scene.meshes.size() == 1);
    return loaded.scene.meshes[0];
}

}  // namespace

TEST_CASE("morph targets move positions, normals and tangents by their weights")
{
    GltfFixture fixture = with_targets();
    CHECK(only_mesh(fixture.load()).positions[2] == Vec3(0, 1, 0));  // no weights: at rest

    fixture.json["meshes"][0]["weights"] = {0.5, 0.0};
    const LoadedScene half = fixture.load();
    CHECK(only_mesh(half).positions == std::vector<Vec3>{{0, 0, 0.5f}, {1, 0, 1}, {0, 1, 2}});
    CHECK(only_mesh(half).normals[1] == Vec3(0, 0, 1));

    fixture.json["nodes"][0]["weights"] = {0.5, 1.0};  // the node's own count
    const LoadedScene both = fixture.load();
    const MeshDesc& mesh = only_mesh(both);
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 1.5f}, {1, 0, 3}, {0, 1, 6}});
    CHECK(mesh.normals[1].x == Approx(std::sqrt(0.5)));
    CHECK(mesh.normals[1].z == Approx(std::sqrt(0.5)));
    CHECK(mesh.tangents[1].x == Approx(std::sqrt(0.5)));
    CHECK(mesh.tangents[1].y == Approx(std::sqrt(0.5)));
    CHECK(mesh.tangents[1].w == -1.0f);
    CHECK(both.warnings.empty());
}

TEST_CASE("morph targets move texture coordinates and colours")
{
    GltfFixture fixture = GltfFixture::triangle();
    auto& primitive = primitive_of(fixture);
    primitive["attributes"]["TEXCOORD_0"] =
        fixture.add_accessor(f32, "VEC2", 3, bytes_of<float>({0, 0, 1, 0, 0, 1}));
    primitive["attributes"]["COLOR_0"] =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}));
    const int uvs = fixture.add_accessor(f32, "VEC2", 3, bytes_of<float>({2, 4, 2, 4, 2, 4}));
    const int colors =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({-1, 1, 0, -1, 1, 0, -1, 1, 0}));
    primitive["targets"] = {{{"TEXCOORD_0", uvs}, {"COLOR_0", colors}}};
    fixture.json["nodes"][0]["weights"] = {0.25};
    const LoadedScene loaded = fixture.load();
    CHECK(only_mesh(loaded).uvs[0][1] == Vec2(1.5f, 1.0f));
    CHECK(only_mesh(loaded).colors[2] == Vec4(0.75f, 0.25f, 0, 1));

    // Each set by displacements of its own.
    primitive["attributes"]["TEXCOORD_1"] = primitive["attributes"]["TEXCOORD_0"];
    const std::vector<Vec2> rest{{0, 0}, {1, 0}, {0, 1}};
    CHECK(only_mesh(fixture.load()).uvs[1] == rest);
    primitive["targets"][0]["TEXCOORD_1"] =
        fixture.add_accessor(f32, "VEC2", 3, bytes_of<float>({-4, 8, -4, 8, -4, 8}));
    const LoadedScene both = fixture.load();
    CHECK(only_mesh(both).uvs[0][1] == Vec2(1.5f, 1.0f));
    CHECK(only_mesh(both).uvs[1] == std::vector<Vec2>{{-1, 2}, {0, 2}, {-1, 3}});
    primitive["targets"][0].erase("TEXCOORD_0");
    CHECK(only_mesh(fixture.load()).uvs[0] == rest);
}

TEST_CASE("nodes share a mesh as far as its weights are the same")
{
    GltfFixture fixture = with_targets();
    for (const nlohmann::json& weights :
         {nlohmann::json{0.0, 0.0}, nlohmann::json{0.5}, nlohmann::json{0.5, 0.0}}) {
        fixture.json["nodes"].push_back({{"mesh", 0}, {"weights", weights}});
    }
    fixture.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.scene.meshes.size() == 2);
    const std::vector<InstanceDesc>& instances = loaded.scene.instances;
    REQUIRE(instances.size() == 4);
    CHECK(instances[0].mesh == instances[1].mesh);
    CHECK(instances[2].mesh == instances[3].mesh);
}

TEST_CASE("weights of morph targets are animated")
{
    GltfFixture fixture = with_targets();
    const int input = fixture.add_accessor(f32, "SCALAR", 2, bytes_of<float>({0, 1}));
    const int output = fixture.add_accessor(f32, "SCALAR", 4, bytes_of<float>({0, 0, 1, 0.5f}));
    fixture.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    const LoadedScene loaded = fixture.load({.time = 0.5});
    CHECK(only_mesh(loaded).positions[2].z == Approx(4 * 0.5 + 4 * 0.25));
}

TEST_CASE("a skin takes vertices to where their joints are")
{
    GltfFixture fixture = with_skin();
    const LoadedScene unbound = fixture.load();
    CHECK(only_mesh(unbound).positions == std::vector<Vec3>{{1, 0, 0}, {2, 8, 0}, {1, 7, 0}});
    CHECK(unbound.scene.instances.at(0).world_from_object == Mat4(1.0f));
    CHECK(unbound.warnings.empty());

    bind(fixture);
    const LoadedScene bound = fixture.load();
    CHECK(only_mesh(bound).positions == std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}});
    CHECK(only_mesh(bound).triangles[0] == UVec3(0, 1, 2));

    // The second joint turned by a quarter about x: the vertex that it holds goes along.
    fixture.json["nodes"][2]["rotation"] = {0.70710678, 0, 0, 0.70710678};
    const LoadedScene turned = fixture.load();
    CHECK(only_mesh(turned).positions[1].y == Approx(8));
    CHECK(only_mesh(turned).positions[1].z == Approx(-8));
    CHECK(only_mesh(turned).normals[1].y == Approx(-1));
    CHECK(only_mesh(turned).normals[0].z == Approx(1));
}

TEST_CASE("normals under a skin that stretches stay normal to the surface")
{
    GltfFixture fixture = with_skin();
    auto& attributes = primitive_of(fixture)["attributes"];
    attributes["NORMAL"] =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 1, 1, 0, 1, 1, 0, 1, 1}));
    attributes["JOINTS_0"] = fixture.add_accessor(
        u16, "VEC4", 3, bytes_of<std::uint16_t>(std::vector<std::uint16_t>(12)));
    attributes["TANGENT"] = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({0, 1, -1, 1, 0, 1, -1, 1, 0, 1, -1, 1}));
    const auto load_scaled = [&fixture](float x, float y) {
        fixture.json["nodes"][1]["scale"] = {x, y, 1};
        return fixture.load().scene.meshes.at(0);
    };
    const MeshDesc stretched = load_scaled(1, 3);
    CHECK(stretched.positions[2] == Vec3(1, 3, 0));
    const Vec3 n = stretched.normals[0];
    CHECK(n.y == Approx(1.0 / std::sqrt(10.0)));
    CHECK(n.z == Approx(3.0 / std::sqrt(10.0)));
    CHECK(glm::dot(n, Vec3(stretched.tangents[0])) == Approx(0.0).margin(1e-6));
    CHECK(stretched.tangents[0].w == 1.0f);

    // Mirrored: the front stays the front, and the handedness changes.
    const MeshDesc mirrored = load_scaled(-1, 1);
    CHECK(mirrored.triangles[0] == UVec3(0, 2, 1));
    CHECK(mirrored.normals[0].z == Approx(std::sqrt(0.5)));
    CHECK(mirrored.tangents[0].w == -1.0f);

    // Flat: the normal is that of the plane.
    const MeshDesc flat = load_scaled(1, 0);
    CHECK(std::abs(flat.normals[0].y) == Approx(1.0));
}

TEST_CASE("weights of joints are made to add up to one")
{
    GltfFixture fixture = with_skin();
    auto& attributes = primitive_of(fixture)["attributes"];
    attributes["WEIGHTS_0"] = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({2, 0, 0, 0, 0, 0, 0, 0, 1, 3, -1, NAN}));
    const LoadedScene loaded = fixture.load();
    CHECK(only_mesh(loaded).positions == std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {1, 7, 0}});
    CHECK(warns(loaded.warnings, {"WEIGHTS_0: vertex 0: 2", "do not sum to 1"}));
    CHECK(warns(loaded.warnings, {"WEIGHTS_0: vertex 1: 0", "first joint"}));
    CHECK(warns(loaded.warnings, {"WEIGHTS_0: vertex 2: -1", "treated as 0", "and 1 more"}));

    // Weights of eight bits are fractions, whether they say so or not.
    attributes["WEIGHTS_0"] = fixture.add_accessor(
        u8, "VEC4", 3, bytes_of<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0}));
    const LoadedScene bytes = fixture.load();
    CHECK(only_mesh(bytes).positions[2].y == Approx(1 + 8 * 0.8));
    CHECK(bytes.warnings.empty());
}

TEST_CASE("eight joints may move a vertex")
{
    GltfFixture fixture = with_skin();
    auto& attributes = primitive_of(fixture)["attributes"];
    attributes["WEIGHTS_0"] = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.125f, 0.375f, 0, 0}));
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    const LoadedScene loaded = fixture.load();
    CHECK(only_mesh(loaded).positions == std::vector<Vec3>{{1, 0, 0}, {2, 8, 0}, {1, 7, 0}});
    CHECK(loaded.warnings.empty());
}

TEST_CASE("skins that make no sense are refused by name, or are not followed")
{
    GltfFixture fixture = with_skin();
    fixture.json["skins"][0]["joints"] = {1};
    Error error = fixture.error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "attributes/JOINTS_0: vertex 1: joint 1, but the skin has 1"));

    fixture.json["skins"][0]["joints"] = nlohmann::json::array();
    CHECK(contains(fixture.error().what(), "/skins/0/joints: a skin needs at least one"));

    fixture.json["skins"][0]["joints"] = {1, 2, 1};
    bind(fixture);
    CHECK(contains(fixture.error().what(),
                   "/skins/0/inverseBindMatrices: 2 matrices, but the number of joints is 3"));

    GltfFixture loose = with_skin();
    primitive_of(loose)["attributes"].erase("JOINTS_0");
    const LoadedScene loaded = loose.load();
    CHECK(only_mesh(loaded).positions[1] == Vec3(1, 0, 0));
    const Vec3 place(loaded.scene.instances.at(0).world_from_object[3]);
    CHECK(DVec3(place) + loaded.scene.origin == DVec3(100, 0, 0));
    CHECK(warns(loaded.warnings, {"/meshes/0/primitives/0", "does not follow its skin"}));

    GltfFixture infinite = with_skin();
    bind(infinite, INFINITY);
    CHECK(contains(infinite.error().what(), "attributes/POSITION: vertex"));
}

TEST_CASE("vertex data is counted against a limit as often as it is used")
{
    GltfFixture fixture = with_targets();
    GltfOptions options;
    options.limits.mesh_bytes = 1300;
    CHECK(std::string(fixture.error(options).what()).empty());
    // The same few bytes in another hundred meshes.
    const nlohmann::json primitive = primitive_of(fixture);
    for (int i = 0; i < 100; ++i) {
        fixture.add_mesh_node(primitive);
    }
    const Error error = fixture.error(options);
    CHECK(error.code() == ErrorCode::invalid_input);
    CAPTURE(error.what());
    CHECK(contains(
        error.what(),
        "/meshes/2/primitives/0: vertices, key frames, light profiles and instances need"));
    CHECK(contains(error.what(), "but the limit is 1.3 kB"));
}

TEST_CASE("triangles without area are counted")
{
    GltfFixture fixture = GltfFixture::triangle();
    primitive_of(fixture)["indices"] =
        fixture.add_accessor(u8, "SCALAR", 9, bytes_of<std::uint8_t>({0, 1, 2, 0, 1, 1, 2, 2, 2}));
    const LoadedScene loaded = fixture.load();
    CHECK(only_mesh(loaded).triangles.size() == 3);
    CHECK(warns(loaded.warnings, {"/meshes/0/primitives/0: 2 of 3", "without area"}));
}

}  // namespace bdpt::test::deformation_test
