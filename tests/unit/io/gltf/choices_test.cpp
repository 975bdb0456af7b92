#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

namespace bdpt::test::choices_test {
using namespace bdpt::io;

namespace {

/// A shoe in three variants: two have a material, the third has that of the primitive.
GltfFixture shoe()
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["extensionsUsed"] = {"KHR_materials_variants"};
    fixture.json["materials"] = {{{"name", "plain"}}, {{"name", "sea"}}, {{"name", "sand"}}};
    fixture.json["extensions"]["KHR_materials_variants"]["variants"] = {
        {{"name", "beach"}}, {{"name", "ocean"}}, {{"name", "street"}}};
    auto& primitive = fixture.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 2}, {"variants", {0}}}, {{"material", 1}, {"variants", {1}}}};
    return fixture;
}

std::string material_of(const LoadedScene& loaded)
{
    const auto index = static_cast<std::size_t>(loaded.scene.instances.at(0).material);
    return loaded.scene.materials.at(index).name;
}

/// A triangle's node with these attributes of EXT_mesh_gpu_instancing.
GltfFixture instanced(const nlohmann::json& attributes)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    fixture.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    return fixture;
}

}  // namespace

TEST_CASE("a variant of materials is chosen by name or index")
{
    const GltfFixture fixture = shoe();
    CHECK(material_of(fixture.load()) == "plain");
    CHECK(material_of(fixture.load({.variant = "beach"})) == "sand");
    CHECK(material_of(fixture.load({.variant = "ocean"})) == "sea");
    CHECK(material_of(fixture.load({.variant = "1"})) == "sea");
    CHECK(material_of(fixture.load({.variant = "street"})) == "plain");
    CHECK(fixture.load().facts.variant_names ==
          std::vector<std::string>{"beach", "ocean", "street"});
    CHECK(fixture.load().warnings.empty());
    const Error error = fixture.error({.variant = "forest"});
    CHECK(error.code() == ErrorCode::not_found);
    CHECK(contains(
        error.what(),
        "no variant \"forest\"; the file has 3 variants: 0 \"beach\", 1 \"ocean\", 2 \"street\""));
    CHECK(contains(GltfFixture::triangle().error({.variant = "x"}).what(),
                   "no variant \"x\"; the file has no variants"));
}

TEST_CASE("mappings of variants are checked")
{
    const auto error_of = [](const char* member, const nlohmann::json& value) {
        GltfFixture fixture = shoe();
        auto& primitive = fixture.json["meshes"][0]["primitives"][0];
        primitive["extensions"]["KHR_materials_variants"]["mappings"][1][member] = value;
        return std::string(fixture.error().what());
    };
    const std::string place =
        "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/1/";
    CHECK(contains(error_of("material", 3),
                   place + "material: index 3, but the number of materials is 3"));
    CHECK(contains(error_of("variants", {0, 7}), place + "variants/1: index 7"));
    CHECK(contains(error_of("variants", 1), place + "variants: must be an array"));
}

TEST_CASE("hidden nodes and what is below them are not shown")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["extensionsRequired"] = {"KHR_node_visibility", "KHR_lights_punctual"};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    fixture.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const nlohmann::json hidden{{"KHR_node_visibility", {{"visible", false}}}};
    const nlohmann::json visible{{"KHR_node_visibility", {{"visible", true}}}};
    const nlohmann::json light{{"KHR_lights_punctual", {{"light", 0}}}};
    fixture.json["nodes"] = {{{"children", {1, 2, 3}}, {"extensions", hidden}},
                             {{"mesh", 0}, {"extensions", visible}},
                             {{"extensions", light}},
                             {{"camera", 0}},
                             {{"mesh", 0}, {"name", "seen"}, {"extensions", visible}}};
    fixture.json["scenes"][0]["nodes"] = {0, 4};
    const LoadedScene loaded = fixture.load();
    REQUIRE(loaded.scene.instances.size() == 1);
    CHECK(loaded.scene.instances[0].name == "seen");
    CHECK(loaded.scene.lights.empty());
    CHECK(loaded.cameras.size() == 1);  // Visibility does not affect cameras.

    fixture.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = true;
    CHECK(fixture.load().scene.instances.size() == 2);
    CHECK(fixture.load().scene.lights.size() == 1);
    fixture.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = "no";
    CHECK(contains(fixture.error().what(),
                   "/nodes/0/extensions/KHR_node_visibility/visible: must be true or false"));
}

TEST_CASE("instances are placed by translation, rotation and scale")
{
    GltfFixture fixture = instanced(nlohmann::json::object());
    const int translations =
        fixture.add_accessor(f32, "VEC3", 2, bytes_of<float>({1, 0, 0, 0, 5, 0}));
    const int rotations =
        fixture.add_accessor(i8, "VEC4", 2, bytes_of<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}));
    const int scales = fixture.add_accessor(f32, "VEC3", 2, bytes_of<float>({1, 1, 1, 2, 3, 4}));
    auto& node = fixture.json["nodes"][0];
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
    node["translation"] = {0, 0, 9};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.warnings.empty());
    CHECK(loaded.scene.meshes.size() == 1);
    REQUIRE(loaded.scene.instances.size() == 2);
    CHECK(loaded.scene.instances[0].world_from_object[3] == Vec4(1, 0, 9, 1));
    // Scaled, turned half around z, moved.
    const Vec4 corner = loaded.scene.instances[1].world_from_object * Vec4(1, 1, 1, 1);
    CHECK(corner.x == Approx(-2));
    CHECK(corner.y == Approx(5 - 3));
    CHECK(corner.z == Approx(9 + 4));
}

TEST_CASE("too many instances are refused before they are read")
{
    // Elements that are stored nowhere: a few bytes ask for gigabytes.
    GltfFixture fixture = instanced(nlohmann::json::object());
    fixture.json["accessors"].push_back(
        {{"componentType", f32}, {"count", 20'000'000}, {"type", "VEC3"}});
    fixture.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", 2}};
    GltfOptions options;
    options.limits.memory_bytes = 1'000'000;  // a read would break this limit first
    const Error error = fixture.error(options);
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(),
                   "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes: 20000000 instances, "
                   "but the limits allow 10000000 more"));
}

TEST_CASE("attributes of instances must fit")
{
    GltfFixture fixture = instanced({{"TRANSLATION", 0}});
    CHECK(fixture.load().scene.instances.size() == 3);

    auto& attributes =
        fixture.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["SCALE"] = fixture.add_accessor(f32, "VEC3", 1, bytes_of<float>({1, 1, 1}));
    Error error = fixture.error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/"));
    CHECK(contains(error.what(), "values, but"));
    attributes = {{"TRANSLATION", 1}};
    CHECK(contains(fixture.error().what(), "/accessors/1/type: must be VEC3"));
    attributes = {{"TRANSLATION", 9}};
    CHECK(contains(fixture.error().what(),
                   "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION: index 9"));

    attributes = {{"TRANSLATION", 0}};
    GltfOptions little;
    little.limits.mesh_bytes = 3000;
    CHECK(std::string(fixture.error(little).what()).empty());
    fixture.json["nodes"][0]["name"] = std::string(1000, 'n');
    CHECK(contains(fixture.error(little).what(),
                   "/nodes/0: vertices, key frames, light profiles and instances"));

    GltfFixture many = instanced({{"TRANSLATION", 2}});
    many.json["accessors"].push_back(
        {{"componentType", 5126}, {"count", 50'000'000}, {"type", "VEC3"}});
    GltfOptions options;
    options.limits.mesh_bytes = std::uint64_t{1} << 30;
    error = many.error(options);
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "50000000 instances, but the limits allow"));
}

}  // namespace bdpt::test::choices_test
