#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <cmath>
#include <limits>

namespace bdpt::test::mesh_test {
using namespace bdpt::io;

namespace {

/// Six points; indexed or not, they make triangles by the mode.
LoadedScene load_mode(int mode, bool indexed)
{
    GltfFixture fixture;
    fixture.add_accessor(f32, "VEC3", 6,
                         bytes_of<float>({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0}));
    fixture.add_accessor(u8, "SCALAR", 5, bytes_of<std::uint8_t>({5, 4, 3, 2, 1}));
    nlohmann::json primitive{{"attributes", {{"POSITION", 0}}}, {"mode", mode}};
    if (indexed) {
        primitive["indices"] = 1;
    }
    fixture.add_mesh_node(primitive);
    return fixture.load();
}

/// A triangle with one more attribute.
GltfFixture with_attribute(const std::string& semantic, ComponentType component,
                           const std::string& type, std::string_view bytes)
{
    GltfFixture fixture = GltfFixture::triangle();
    const int accessor = fixture.add_accessor(component, type, 3, bytes);
    fixture.json["meshes"][0]["primitives"][0]["attributes"][semantic] = accessor;
    return fixture;
}

}  // namespace

TEST_CASE("a triangle is read with its indices")
{
    const LoadedScene loaded = GltfFixture::triangle().load();
    REQUIRE(loaded.scene.meshes.size() == 1);
    const MeshDesc& mesh = loaded.scene.meshes[0];
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<UVec3>{{0, 1, 2}});
    CHECK(mesh.normals.empty());
    CHECK(mesh.tangents.empty());
    CHECK(mesh.uvs[0].empty());
    CHECK(mesh.colors.empty());
    CHECK(loaded.warnings.empty());
}

TEST_CASE("primitive modes give triangles in the order of the specification")
{
    using Triangles = std::vector<UVec3>;
    CHECK(load_mode(4, false).scene.meshes.at(0).triangles == Triangles{{0, 1, 2}, {3, 4, 5}});
    CHECK(load_mode(5, false).scene.meshes.at(0).triangles ==
          Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}});
    CHECK(load_mode(6, false).scene.meshes.at(0).triangles ==
          Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}});
    CHECK(load_mode(5, true).scene.meshes.at(0).triangles ==
          Triangles{{5, 4, 3}, {4, 2, 3}, {3, 2, 1}});
    CHECK(load_mode(6, true).scene.meshes.at(0).triangles ==
          Triangles{{4, 3, 5}, {3, 2, 5}, {2, 1, 5}});

    const LoadedScene incomplete = load_mode(4, true);
    CHECK(incomplete.scene.meshes.at(0).triangles == Triangles{{5, 4, 3}});
    CHECK(warns(incomplete.warnings, {"/meshes/0/primitives/0", "whole triangles", "5"}));
    for (int mode = 0; mode < 4; ++mode) {
        const LoadedScene skipped = load_mode(mode, false);
        CHECK(skipped.scene.instances.empty());
        CHECK(warns(skipped.warnings, {"/meshes/0/primitives/0", "points and lines"}));
    }
}

TEST_CASE("warnings of one kind are counted")
{
    GltfFixture fixture = GltfFixture::triangle();
    for (int i = 0; i < 3; ++i) {
        fixture.add_mesh_node({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    }
    const std::vector<std::string> warnings = fixture.load().warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(contains(warnings[0], "/meshes/1/primitives/0: mode 0"));
    CHECK(contains(warnings[0], "and 2 more"));
}

TEST_CASE("sparse values replace those of the accessor")
{
    GltfFixture fixture = GltfFixture::triangle();
    const int indices = fixture.add_view(bytes_of<std::uint16_t>({0, 2}));
    const int values = fixture.add_view(bytes_of<float>({7, 8, 9, 4, 5, 6}));
    fixture.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    CHECK(fixture.load().scene.meshes.at(0).positions ==
          std::vector<Vec3>{{7, 8, 9}, {1, 0, 0}, {4, 5, 6}});

    SECTION("without a view they replace zeros")
    {
        fixture.json["accessors"][0].erase("bufferView");
        CHECK(fixture.load().scene.meshes.at(0).positions ==
              std::vector<Vec3>{{7, 8, 9}, {0, 0, 0}, {4, 5, 6}});
    }
    SECTION("their indices must be in range")
    {
        fixture.bin.replace(fixture.json["bufferViews"][2]["byteOffset"].get<std::size_t>() + 2, 2,
                            bytes_of<std::uint16_t>({3}));
        const Error error = fixture.error();
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "/accessors/0/sparse/indices: element 1 is 3"));
    }
    SECTION("their indices must increase")
    {
        fixture.bin.replace(fixture.json["bufferViews"][2]["byteOffset"].get<std::size_t>() + 2, 2,
                            bytes_of<std::uint16_t>({0}));
        const Error error = fixture.error();
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "must increase"));
    }
}

TEST_CASE("strides and offsets are followed")
{
    GltfFixture fixture = GltfFixture::triangle();
    const int view =
        fixture.add_view(bytes_of<float>({-1, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9, 0, 0}));
    fixture.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 16;
    fixture.json["accessors"][0]["bufferView"] = view;
    fixture.json["accessors"][0]["byteOffset"] = 4;
    CHECK(fixture.load().scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("quantised positions are read as integers or as fractions")
{
    GltfFixture fixture;
    fixture.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    fixture.add_accessor(i16, "VEC3", 3,
                         bytes_of<std::int16_t>({0, 0, 0, 100, 0, 0, 0, -32768, 32767}));
    fixture.add_mesh_node({{"attributes", {{"POSITION", 0}}}});
    CHECK(fixture.load().scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {100, 0, 0}, {0, -32768, 32767}});
    fixture.json["accessors"][0]["normalized"] = true;
    CHECK(fixture.load().scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {100.0f / 32767.0f, 0, 0}, {0, -1, 1}});
}

TEST_CASE("texture coordinates of both sets are read")
{
    const GltfFixture floats =
        with_attribute("TEXCOORD_0", f32, "VEC2", bytes_of<float>({0, 1, 2, -3, 0.5f, 0.25f}));
    CHECK(floats.load().scene.meshes.at(0).uvs[0] ==
          std::vector<Vec2>{{0, 1}, {2, -3}, {0.5f, 0.25f}});

    GltfFixture shorts = with_attribute(
        "TEXCOORD_1", u16, "VEC2", bytes_of<std::uint16_t>({0, 65535, 13107, 0, 65535, 26214}));
    shorts.json["accessors"][2]["normalized"] = true;
    const MeshDesc mesh = shorts.load().scene.meshes.at(0);
    CHECK(mesh.uvs[0].empty());
    CHECK(mesh.uvs[1] == std::vector<Vec2>{{0, 1}, {0.2f, 0}, {1, 0.4f}});
}

TEST_CASE("vertex colours get an alpha of one and integers are fractions")
{
    const GltfFixture rgb =
        with_attribute("COLOR_0", f32, "VEC3", bytes_of<float>({1, 0, 0, 0, 0.5f, 0, 0, 0, 0.25f}));
    CHECK(rgb.load().scene.meshes.at(0).colors ==
          std::vector<Vec4>{{1, 0, 0, 1}, {0, 0.5f, 0, 1}, {0, 0, 0.25f, 1}});

    const GltfFixture rgba =
        with_attribute("COLOR_0", u8, "VEC4",
                       bytes_of<std::uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 255, 255, 255, 255}));
    CHECK(rgba.load().scene.meshes.at(0).colors ==
          std::vector<Vec4>{{1, 0, 0.2f, 0.4f}, {0, 0, 0, 0}, {1, 1, 1, 1}});

    const GltfFixture beyond =
        with_attribute("COLOR_0", f32, "VEC3", bytes_of<float>({2, 0, 0, -1, 0.5f, 0, 0, 0, NAN}));
    const LoadedScene loaded = beyond.load();
    CHECK(loaded.scene.meshes.at(0).colors ==
          std::vector<Vec4>{{1, 0, 0, 1}, {0, 0.5f, 0, 1}, {0, 0, 0, 1}});
    CHECK(warns(loaded.warnings, {"/meshes/0/primitives/0/attributes/COLOR_0", "and 2 more"}));
}

TEST_CASE("normals are made unit vectors")
{
    const GltfFixture fixture = with_attribute(
        "NORMAL", f32, "VEC3", bytes_of<float>({0, 0, 1e-3f, 0, 3e19f, 4e19f, 0, 0, 0}));
    const LoadedScene loaded = fixture.load();
    const std::vector<Vec3>& normals = loaded.scene.meshes.at(0).normals;
    REQUIRE(normals.size() == 3);
    CHECK(normals[0] == Vec3(0, 0, 1));
    CHECK(normals[1].y == Approx(0.6));
    CHECK(normals[1].z == Approx(0.8));
    CHECK(normals[2] == Vec3(0, 0, 1));  // that of the face
    CHECK(warns(loaded.warnings, {"/meshes/0/primitives/0/attributes/NORMAL", "faces"}));
}

TEST_CASE("tangents keep their handedness")
{
    GltfFixture fixture = with_attribute("TANGENT", f32, "VEC4",
                                         bytes_of<float>({2, 0, 0, 1, 0, 1, 0, -1, 1, 0, 0, 1}));
    CHECK(fixture.load().scene.meshes.at(0).tangents.empty());  // nothing without normals
    fixture.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    CHECK(fixture.load().scene.meshes.at(0).tangents ==
          std::vector<Vec4>{{1, 0, 0, 1}, {0, 1, 0, -1}, {1, 0, 0, 1}});
}

TEST_CASE("positions that are not finite are refused by name")
{
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfFixture fixture = GltfFixture::triangle();
        fixture.json["meshes"][0]["name"] = "chair";
        fixture.bin.replace(16, 4, bytes_of<float>({bad}));
        const Error error = fixture.error();
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "/meshes/0/primitives/0/attributes/POSITION"));
        CHECK(contains(error.what(), "mesh \"chair\": vertex 1: y is "));
    }
}

TEST_CASE("indices beyond the vertices are refused by name")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.bin.replace(36 + 4, 2, bytes_of<std::uint16_t>({912}));
    const Error error = fixture.error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(
        error.what(),
        "/meshes/0/primitives/0/indices: element 2 is 912, but the number of vertices is 3"));
}

TEST_CASE("attributes with too few values are refused, with too many cut")
{
    GltfFixture fixture = GltfFixture::triangle();
    const auto set_uvs = [&fixture](std::size_t count) {
        fixture.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
            fixture.add_accessor(f32, "VEC2", count,
                                 bytes_of<float>(std::vector<float>(2 * count, 0.5f)));
    };
    set_uvs(2);
    const Error error = fixture.error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(
        contains(error.what(), "attributes/TEXCOORD_0: 2 values, but the number of vertices is 3"));
    set_uvs(4);
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.scene.meshes.at(0).uvs[0].size() == 3);
    CHECK(warns(loaded.warnings, {"attributes/TEXCOORD_0", "more values"}));
}

}  // namespace bdpt::test::mesh_test
