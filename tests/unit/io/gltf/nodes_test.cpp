#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

namespace bdpt::test::nodes_test {
using namespace bdpt::io;

namespace {

/// Two triangles' worth of nodes is enough for all hierarchies: mesh 0 wherever it is asked for.
GltfFixture with_nodes(const nlohmann::json& nodes, const nlohmann::json& roots)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["nodes"] = nodes;
    fixture.json["scenes"][0]["nodes"] = roots;
    return fixture;
}

Vec3 moved(const InstanceDesc& instance, Vec3 point)
{
    return Vec3(instance.world_from_object * Vec4(point, 1.0f));
}

}  // namespace

TEST_CASE("transforms are applied scale first and parents last")
{
    // A quarter turn about z.
    const nlohmann::json turn{0.0, 0.0, 0.70710678118654752, 0.70710678118654752};
    const LoadedScene loaded = with_nodes({{{"translation", {10, 0, 0}}, {"children", {1}}},
                                           {{"mesh", 0},
                                            {"name", "arm"},
                                            {"translation", {1, 2, 3}},
                                            {"rotation", turn},
                                            {"scale", {2, 3, 4}}}},
                                          {0})
                                   .load();
    REQUIRE(loaded.scene.instances.size() == 1);
    const InstanceDesc& instance = loaded.scene.instances[0];
    CHECK(instance.name == "arm");
    const Vec3 point = moved(instance, {1, 1, 1});  // scaled (2,3,4), turned (-3,2,4)
    CHECK(point.x == Approx(10 + 1 - 3));
    CHECK(point.y == Approx(2 + 2));
    CHECK(point.z == Approx(3 + 4));
    CHECK(loaded.warnings.empty());
}

TEST_CASE("matrices are column by column")
{
    const LoadedScene loaded =
        with_nodes(
            {{{"mesh", 0}, {"matrix", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1}}}}, {0})
            .load();
    CHECK(loaded.scene.instances.at(0).world_from_object ==
          Mat4(1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1));
}

TEST_CASE("rotations that are not of unit length are normalised with a warning")
{
    const LoadedScene loaded = with_nodes({{{"mesh", 0}, {"rotation", {0, 0, 2, 2}}},
                                           {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}},
                                          {0, 1})
                                   .load();
    const Vec3 turned = moved(loaded.scene.instances.at(0), {1, 0, 0});
    CHECK(turned.x == Approx(0).margin(1e-6));
    CHECK(turned.y == Approx(1));
    CHECK(moved(loaded.scene.instances.at(1), {1, 2, 3}) == Vec3(1, 2, 3));
    CHECK(warns(loaded.warnings, {"/nodes/0/rotation", "2.828"}));
    CHECK(warns(loaded.warnings, {"/nodes/1/rotation", "length 0"}));
}

TEST_CASE("nodes share the meshes that they use")
{
    GltfFixture fixture = with_nodes({{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}}, {0, 1});
    fixture.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    fixture.json["materials"] = {{{"name", "paint"}}};
    fixture.json["meshes"][0]["primitives"][1]["material"] = 0;
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.scene.meshes.size() == 2);
    CHECK(loaded.scene.materials.size() == 2);
    REQUIRE(loaded.scene.instances.size() == 4);
    CHECK(loaded.scene.instances[0].mesh == loaded.scene.instances[2].mesh);
    CHECK(loaded.scene.instances[1].mesh == loaded.scene.instances[3].mesh);
    const auto material = [&loaded](std::size_t i) {
        return loaded.scene.materials.at(
            static_cast<std::size_t>(loaded.scene.instances[i].material));
    };
    CHECK(material(0).name == "default");
    CHECK(material(0).metallic == 1.0f);
    CHECK(material(3).name == "paint");
    CHECK(moved(loaded.scene.instances[2], {1, 0, 0}) == Vec3(-1, 0, 0));
}

TEST_CASE("nodes and materials without a name are called by their place in the document")
{
    GltfFixture fixture =
        with_nodes({{{"children", {1, 2}}}, {{"mesh", 0}}, {{"mesh", 0}, {"name", "b"}}}, {0});
    fixture.json["meshes"][0]["name"] = "shared";
    fixture.json["meshes"][0]["primitives"][0]["material"] = 1;
    fixture.json["materials"] = {{{"name", "unused"}}, nlohmann::json::object()};
    const LoadedScene loaded = fixture.load();
    REQUIRE(loaded.scene.instances.size() == 2);
    CHECK(loaded.scene.instances[0].name == "node_1");
    CHECK(loaded.scene.instances[1].name == "b");
    REQUIRE(loaded.scene.materials.size() == 1);
    CHECK(loaded.scene.materials[0].name == "material_1");
}

TEST_CASE("a scene is chosen by name, by index or by default")
{
    GltfFixture fixture =
        with_nodes({{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}}, {0});
    fixture.json["scenes"] = {{{"nodes", {0}}, {"name", "day"}},
                              {{"nodes", {1}}, {"name", "night"}}};
    fixture.json["scene"] = 1;
    const auto first_name = [&fixture](std::optional<std::string> scene) {
        return fixture.load({.scene = std::move(scene), .limits = {}}).scene.instances.at(0).name;
    };
    CHECK(first_name(std::nullopt) == "b");
    CHECK(first_name("day") == "a");
    CHECK(first_name("night") == "b");
    CHECK(first_name("0") == "a");
    fixture.json.erase("scene");
    CHECK(first_name(std::nullopt) == "a");
    CHECK(fixture.load().facts.scene == 0u);
    CHECK(fixture.load().facts.scene_names == std::vector<std::string>{"day", "night"});

    for (const char* wrong : {"noon", "2", "-1", ""}) {
        const Error error = fixture.error({.scene = wrong, .limits = {}});
        CHECK(error.code() == ErrorCode::not_found);
        CHECK(contains(error.what(), "0 \"day\", 1 \"night\""));
    }
}

TEST_CASE("without scenes all root nodes are shown")
{
    GltfFixture fixture = with_nodes({{{"children", {1}}}, {{"mesh", 0}}, {{"mesh", 0}}}, {0});
    fixture.json.erase("scene");
    fixture.json.erase("scenes");
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.scene.instances.size() == 2);
    CHECK_FALSE(loaded.facts.scene);
    CHECK(warns(loaded.warnings, {"/scenes", "no scene"}));
}

TEST_CASE("an empty scene loads with nothing in it")
{
    const LoadedScene loaded = GltfFixture().load();
    CHECK(loaded.scene.instances.empty());
    CHECK(loaded.scene.meshes.empty());
    CHECK(loaded.warnings.empty());
}

TEST_CASE("a node that a scene lists twice is shown once")
{
    const LoadedScene loaded = with_nodes({{{"children", {1}}}, {{"mesh", 0}}}, {0, 1}).load();
    CHECK(loaded.scene.instances.size() == 1);
    CHECK(warns(loaded.warnings, {"/nodes/1", "once"}));
}

TEST_CASE("a mesh scaled flat keeps its triangles, one scaled to nothing is left out")
{
    const LoadedScene loaded = with_nodes({{{"mesh", 0}, {"scale", {2, 3, 0}}},
                                           {{"mesh", 0}, {"scale", {1, 0, 0}}},
                                           {{"mesh", 0}, {"scale", {0, 0, 0}}}},
                                          {0, 1, 2})
                                   .load();
    REQUIRE(loaded.scene.instances.size() == 1);
    const InstanceDesc& instance = loaded.scene.instances[0];
    CHECK(instance.world_from_object == Mat4(1.0f));
    CHECK(loaded.scene.meshes.at(static_cast<std::size_t>(instance.mesh)).positions ==
          std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}});
    CHECK(warns(loaded.warnings, {"/nodes/0", "flat"}));
    CHECK(warns(loaded.warnings, {"/nodes/1", "left out", "and 1 more"}));
}

TEST_CASE("facts count the whole file")
{
    GltfFixture fixture = with_nodes({{{"mesh", 0}}, {{"name", "unused"}}}, {0});
    fixture.json["asset"]["generator"] = "a test";
    fixture.json["asset"]["copyright"] = "nobody";
    fixture.json["extensionsUsed"] = {"KHR_materials_ior", "MSFT_texture_dds", "EXT_unheard_of"};
    fixture.json["extensionsRequired"] = {"KHR_materials_ior"};
    fixture.json["animations"] = nlohmann::json::array({nlohmann::json::object()});
    fixture.json["extensions"]["KHR_xmp"]["packets"] = {{{"dc:creator", "nobody"}}};
    fixture.json["asset"]["extensions"]["KHR_xmp"]["packet"] = 0;
    const LoadedScene loaded = fixture.load();
    const GltfFacts& facts = loaded.facts;
    CHECK(facts.version == "2.0");
    CHECK(facts.generator == "a test");
    CHECK(facts.copyright == "nobody");
    CHECK(facts.nodes == 2);
    CHECK(facts.meshes == 1);
    CHECK(facts.primitives == 1);
    CHECK(facts.animations == 1);
    CHECK(facts.xmp == R"({"dc:creator":"nobody"})");
    REQUIRE(facts.extensions.size() == 3);
    CHECK(facts.extensions[0].name == "KHR_materials_ior");
    CHECK(facts.extensions[0].required);
    CHECK(facts.extensions[0].status == ExtensionStatus::supported);
    CHECK(facts.extensions[1].status == ExtensionStatus::ignored);
    CHECK_FALSE(facts.extensions[1].note.empty());
    CHECK(facts.extensions[2].status == ExtensionStatus::unknown);
    CHECK(warns(loaded.warnings, {"/extensionsUsed/1", "MSFT_texture_dds", "ignored"}));
    CHECK(warns(loaded.warnings, {"/extensionsUsed/2", "EXT_unheard_of", "unknown"}));
    // What is odd about it does no harm.
    for (const nlohmann::json& packet : {nlohmann::json(1), nlohmann::json("0")}) {
        fixture.json["asset"]["extensions"]["KHR_xmp"]["packet"] = packet;
        CHECK(fixture.load().facts.xmp.empty());
    }
}

}  // namespace bdpt::test::nodes_test
