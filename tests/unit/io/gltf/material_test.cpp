#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <limits>

namespace bdpt::test::material_test {
using namespace bdpt::io;

namespace {

GltfFixture with_material(const nlohmann::json& material)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["materials"] = nlohmann::json::array({material});
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    return fixture;
}

MaterialDesc load_material(const nlohmann::json& material)
{
    return with_material(material).load().scene.materials.at(0);
}

/// A document with six one-pixel images, whose grey level tells them apart, and a texture each.
GltfFixture with_textures(const nlohmann::json& material)
{
    GltfFixture fixture = with_material(material);
    add_grey_textures(fixture);
    return fixture;
}

}  // namespace

TEST_CASE("an empty material has the defaults of the specification")
{
    const MaterialDesc material = load_material(nlohmann::json::object());
    const MaterialDesc defaults;
    CHECK(material.base_color == defaults.base_color);
    CHECK(material.metallic == 1.0f);
    CHECK(material.roughness == 1.0f);
    CHECK(material.emission == Rgb(0));
    CHECK_FALSE(material.double_sided);
    CHECK(material.ior == 1.5f);
    CHECK(material.specular == 1.0f);
    CHECK(material.specular_color == Rgb(1));
    CHECK(material.transmission == 0.0f);
    CHECK(material.thickness == 0.0f);
    CHECK(material.attenuation_distance == std::numeric_limits<float>::infinity());
    CHECK(material.attenuation_color == Rgb(1));
    CHECK_FALSE(material.base_color_texture);
}

TEST_CASE("the factors of a material are read")
{
    const MaterialDesc material =
        load_material({{"name", "glass"},
                       {"doubleSided", true},
                       {"emissiveFactor", {0.25, 0.5, 1}},
                       {"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                         {"metallicFactor", 0.5},
                         {"roughnessFactor", 0.25}}},
                       {"extensions",
                        {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5000000000}}},
                         {"KHR_materials_ior", {{"ior", 1.33}}},
                         {"KHR_materials_specular",
                          {{"specularFactor", 0.75}, {"specularColorFactor", {2, 0.5, 0}}}},
                         {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                         {"KHR_materials_volume",
                          {{"thicknessFactor", 2},
                           {"attenuationDistance", 0.125},
                           {"attenuationColor", {0.5, 1, 0.25}}}}}}});
    CHECK(material.name == "glass");
    CHECK(material.double_sided);
    CHECK(material.emission == Rgb(1.25e9f, 2.5e9f, 5e9f));
    CHECK(material.base_color == Vec4(0.1f, 0.2f, 0.3f, 0.4f));
    CHECK(material.metallic == 0.5f);
    CHECK(material.roughness == 0.25f);
    CHECK(material.ior == 1.33f);
    CHECK(material.specular == 0.75f);
    CHECK(material.specular_color == Rgb(2, 0.5f, 0));
    CHECK(material.transmission == 1.0f);
    CHECK(material.thickness == 2.0f);
    CHECK(material.attenuation_distance == 0.125f);
    CHECK(material.attenuation_color == Rgb(0.5f, 1, 0.25f));
}

TEST_CASE("bodies that scatter are read, by either name of their colour")
{
    const auto scatter = [](const nlohmann::json& extension) {
        return with_material(
                   {{"extensions",
                     {{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 1}}},
                      {"KHR_materials_volume", {{"thicknessFactor", 1}}},
                      {"KHR_materials_volume_scatter", extension}}}})
            .load();
    };
    const auto of = [](const LoadedScene& loaded) {
        return loaded.scene.materials.at(0).volume_scatter;
    };
    const LoadedScene loaded =
        scatter({{"multiscatterColor", {0.5, 0.25, 0}}, {"scatterAnisotropy", 0.75}});
    CHECK(of(loaded).color == Rgb(0.5f, 0.25f, 0.0f));
    CHECK(of(loaded).anisotropy == 0.75f);
    CHECK(loaded.warnings.empty());
    CHECK(of(scatter({{"multiscatterColorFactor", {1, 0.5, 0.25}}})).color ==
          Rgb(1.0f, 0.5f, 0.25f));
    CHECK(of(scatter(nlohmann::json::object())).color == Rgb(0.0f));
    const LoadedScene beyond =
        scatter({{"multiscatterColor", {2, 0, 0}}, {"scatterAnisotropy", -1}});
    CHECK(of(beyond).color == Rgb(1, 0, 0));
    CHECK(of(beyond).anisotropy == -max_anisotropy);
    CHECK(warns(beyond.warnings, {"/materials/0/", "multiscatterColor", "and 1 more"}));
    CHECK_THROWS_AS(scatter({{"multiscatterColor", "red"}}), Error);
    CHECK_THROWS_AS(scatter({{"scatterAnisotropy", {1}}}), Error);
}

TEST_CASE("KHR_materials_scatter is read in bodies with a thickness")
{
    const auto scatter = [](const nlohmann::json& extension, double thickness) {
        return with_material({{"extensions",
                               {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                {"KHR_materials_volume", {{"thicknessFactor", thickness}}},
                                {"KHR_materials_scatter", extension}}}})
            .load();
    };
    const auto of = [](const LoadedScene& loaded) {
        return loaded.scene.materials.at(0).volume_scatter;
    };
    const nlohmann::json half{{"scatterStrengthFactor", 0.5},
                              {"multiscatterColorFactor", {1, 0.5, 0}},
                              {"scatterAnisotropy", 0.25}};
    const LoadedScene body = scatter(half, 1.0);
    CHECK(of(body).color == Rgb(0.5f, 0.25f, 0.0f));
    CHECK(of(body).anisotropy == 0.25f);
    CHECK(body.warnings.empty());
    CHECK(of(scatter(nlohmann::json::object(), 1.0)).color == Rgb(0.0f));
    CHECK(of(scatter({{"scatterStrengthFactor", 1}}, 1.0)).color == Rgb(1.0f));
    const LoadedScene sheet = scatter(half, 0.0);
    CHECK(of(sheet).color == Rgb(0.0f));
    CHECK(warns(sheet.warnings, {"/materials/0/", "KHR_materials_scatter", "thickness"}));
    CHECK_THROWS_AS(scatter({{"scatterStrengthFactor", "much"}}, 1.0), Error);
}

TEST_CASE("values beyond their ranges are brought back with a warning")
{
    const LoadedScene loaded =
        with_material({{"emissiveFactor", {2, -1, 0}},
                       {"pbrMetallicRoughness",
                        {{"baseColorFactor", {1.5, 0, 0, 1}}, {"roughnessFactor", -0.5}}},
                       {"extensions",
                        {{"KHR_materials_ior", {{"ior", 0.5}}},
                         {"KHR_materials_volume", {{"attenuationDistance", 0}}}}}})
            .load();
    const MaterialDesc& material = loaded.scene.materials.at(0);
    CHECK(material.emission == Rgb(2, 0, 0));
    CHECK(material.base_color == Vec4(1, 0, 0, 1));
    CHECK(material.roughness == 0.0f);
    CHECK(material.ior == 1.0f);
    CHECK(material.attenuation_distance == std::numeric_limits<float>::infinity());
    CHECK(warns(loaded.warnings,
                {"/materials/0/pbrMetallicRoughness/baseColorFactor: 1.5", "and 3 more"}));
    CHECK(warns(loaded.warnings, {"attenuationDistance: 0"}));
}

TEST_CASE("an index of refraction of 0 stands for full reflection")
{
    const LoadedScene loaded =
        with_material({{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}}).load();
    const float n = loaded.scene.materials.at(0).ior;
    CHECK((n - 1) * (n - 1) / ((n + 1) * (n + 1)) > 0.999f);
    CHECK(loaded.warnings.empty());
}

TEST_CASE("alpha modes and the cutoff are read")
{
    const nlohmann::json color{{"baseColorFactor", {1, 1, 1, 0.25}}};
    const LoadedScene blend =
        with_material({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", color}}).load();
    CHECK(blend.scene.materials.at(0).alpha_mode == AlphaMode::blend);
    CHECK(blend.scene.materials.at(0).base_color.w == 0.25f);
    CHECK(blend.warnings.empty());
    CHECK(load_material({{"alphaMode", "MASK"}}).alpha_mode == AlphaMode::mask);
    CHECK(load_material({{"alphaMode", "MASK"}}).alpha_cutoff == 0.5f);
    CHECK(load_material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.125}}).alpha_cutoff == 0.125f);
    CHECK(load_material({{"alphaMode", "MASK"}, {"alphaCutoff", 2}}).alpha_cutoff == 2.0f);
    CHECK(load_material({{"alphaMode", "OPAQUE"}}).alpha_mode == AlphaMode::opaque);
    CHECK(load_material(nlohmann::json::object()).alpha_mode == AlphaMode::opaque);
    CHECK(warns(with_material({{"alphaMode", "MASK"}, {"alphaCutoff", -1}}).load().warnings,
                {"/materials/0/alphaCutoff: -1 becomes 0"}));
    const LoadedScene unknown = with_material({{"alphaMode", "HASH"}}).load();
    CHECK(unknown.scene.materials.at(0).alpha_mode == AlphaMode::opaque);
    CHECK(warns(unknown.warnings, {"/materials/0/alphaMode: HASH", "OPAQUE"}));
}

TEST_CASE("an unlit material is its base colour, its alpha and its sides")
{
    const nlohmann::json unlit{{"KHR_materials_unlit", nlohmann::json::object()}};
    GltfFixture fixture = with_textures(
        {{"extensions", unlit},
         {"doubleSided", true},
         {"alphaMode", "BLEND"},
         {"emissiveFactor", {1, 1, 1}},
         {"emissiveTexture", {{"index", 3}}},
         {"normalTexture", {{"index", 1}}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 1, 0.75}}, {"baseColorTexture", {{"index", 2}}}}}});
    fixture.json["extensionsUsed"] = {"KHR_materials_unlit"};
    fixture.json["extensionsRequired"] = {"KHR_materials_unlit"};
    const LoadedScene loaded = fixture.load();
    const MaterialDesc& material = loaded.scene.materials.at(0);
    CHECK(material.unlit);
    CHECK(material.double_sided);
    CHECK(material.alpha_mode == AlphaMode::blend);
    CHECK(material.base_color == Vec4(0.5f, 0.25f, 1.0f, 0.75f));
    CHECK(grey_image(loaded, material.base_color_texture) == 2);
    CHECK_FALSE(material.emission_texture.has_value());
    CHECK_FALSE(material.normal_texture.has_value());
    CHECK(material.emission == Rgb(0.0f));
    CHECK(loaded.warnings.empty());
    CHECK_FALSE(load_material(nlohmann::json::object()).unlit);
}

TEST_CASE("every texture slot finds its image")
{
    const LoadedScene loaded =
        with_textures(
            {{"emissiveFactor", {1, 1, 1}},
             {"emissiveTexture", {{"index", 0}}},
             {"normalTexture", {{"index", 1}, {"scale", 0.5}}},
             {"occlusionTexture", {{"index", 2}}},
             {"pbrMetallicRoughness",
              {{"baseColorTexture", {{"index", 3}}}, {"metallicRoughnessTexture", {{"index", 4}}}}},
             {"extensions",
              {{"KHR_materials_specular",
                {{"specularTexture", {{"index", 5}}}, {"specularColorTexture", {{"index", 0}}}}},
               {"KHR_materials_transmission",
                {{"transmissionFactor", 0.5}, {"transmissionTexture", {{"index", 1}}}}}}}})
            .load();
    const MaterialDesc& material = loaded.scene.materials.at(0);
    CHECK(grey_image(loaded, material.emission_texture) == 0);
    CHECK(grey_image(loaded, material.normal_texture) == 1);
    CHECK(material.normal_scale == 0.5f);
    CHECK(grey_image(loaded, material.base_color_texture) == 3);
    CHECK(grey_image(loaded, material.metallic_roughness_texture) == 4);
    CHECK(grey_image(loaded, material.specular_texture) == 5);
    CHECK(grey_image(loaded, material.specular_color_texture) == 0);
    CHECK(grey_image(loaded, material.transmission_texture) == 1);
    // Each once, and not that of the occlusion.
    CHECK(loaded.scene.images.size() == 5);
    CHECK(loaded.warnings.empty());
}

TEST_CASE("an image of metal and roughness counts if one of its factors does")
{
    const auto image_with = [](float metallic, float roughness) {
        const LoadedScene loaded = with_textures({{"pbrMetallicRoughness",
                                                   {{"metallicFactor", metallic},
                                                    {"roughnessFactor", roughness},
                                                    {"metallicRoughnessTexture", {{"index", 4}}}}}})
                                       .load();
        const MaterialDesc& material = loaded.scene.materials.at(0);
        CHECK(material.metallic == metallic);
        CHECK(material.roughness == roughness);
        return material.metallic_roughness_texture
                   ? grey_image(loaded, material.metallic_roughness_texture)
                   : -1;
    };
    CHECK(image_with(0.0f, 0.5f) == 4);
    CHECK(image_with(0.5f, 0.0f) == 4);
    CHECK(image_with(0.0f, 0.0f) == -1);
}

TEST_CASE("images without influence are not decoded")
{
    const LoadedScene loaded =
        with_textures(
            {{"emissiveTexture", {{"index", 0}}},
             {"extensions",
              {{"KHR_materials_transmission", {{"transmissionTexture", {{"index", 1}}}}}}}})
            .load();
    CHECK(loaded.scene.images.empty());
}

TEST_CASE("samplers give the wrap modes")
{
    GltfFixture fixture =
        with_textures({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const auto ref = [&fixture] {
        return fixture.load().scene.materials.at(0).base_color_texture.value();
    };
    CHECK(ref().wrap_u == Wrap::repeat);
    CHECK(ref().wrap_v == Wrap::repeat);
    fixture.json["textures"][0]["sampler"] = 0;
    fixture.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    CHECK(ref().wrap_u == Wrap::clamp_to_edge);
    CHECK(ref().wrap_v == Wrap::mirrored_repeat);
    fixture.json["samplers"][0]["wrapS"] = 1;
    CHECK(ref().wrap_u == Wrap::repeat);
    CHECK(warns(fixture.load().warnings, {"/samplers/0/wrapS: 1"}));
}

TEST_CASE("texture transforms are read wherever a texture is")
{
    const nlohmann::json transform{
        {"offset", {1, 2}}, {"rotation", 0.5}, {"scale", {3, -4}}, {"texCoord", 1}};
    const nlohmann::json info{
        {"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const MaterialDesc material =
        with_textures({{"normalTexture", info},
                       {"extensions", {{"KHR_materials_specular", {{"specularTexture", info}}}}}})
            .load()
            .scene.materials.at(0);
    for (const auto& ref : {material.normal_texture, material.specular_texture}) {
        REQUIRE(ref);
        CHECK(ref->uv_set == 1);
        CHECK(ref->offset == Vec2(1, 2));
        CHECK(ref->rotation == 0.5f);
        CHECK(ref->scale == Vec2(3, -4));
    }
}

TEST_CASE("a third set of texture coordinates costs the texture, not the image")
{
    const LoadedScene loaded =
        with_textures({{"normalTexture", {{"index", 0}, {"texCoord", 2}}}}).load();
    CHECK_FALSE(loaded.scene.materials.at(0).normal_texture);
    CHECK(warns(loaded.warnings, {"/materials/0/normalTexture: texCoord 2"}));
}

TEST_CASE("materials with wrong references are refused")
{
    GltfFixture fixture = with_textures({{"normalTexture", {{"index", 6}}}});
    CHECK(contains(fixture.error().what(),
                   "/materials/0/normalTexture/index: index 6, but the number of textures is 6"));
    fixture.json["materials"][0] = {
        {"extensions", {{"KHR_materials_specular", {{"specularTexture", {{"index", -1}}}}}}}};
    CHECK(
        contains(fixture.error().what(), "/specularTexture/index: must be a non-negative integer"));
    fixture.json["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}};
    CHECK(contains(fixture.error().what(), "/baseColorFactor: must be 4 numbers"));
    fixture.json["materials"][0] = {{"doubleSided", "yes"}};
    CHECK(contains(fixture.error().what(), "/materials/0/doubleSided: must be true or false"));
    CHECK(fixture.error().code() == ErrorCode::invalid_input);
}

}  // namespace bdpt::test::material_test
