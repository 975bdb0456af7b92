#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

namespace bdpt::test::material_layers_test {
using namespace bdpt::io;

namespace {

/// A triangle whose material has one extension, with six one-pixel textures of different greys.
GltfFixture with_extension(const std::string& name, const nlohmann::json& extension)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["materials"] = {{{"extensions", {{name, extension}}}}};
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    fixture.json["extensionsUsed"] = {name};
    fixture.json["extensionsRequired"] = {name};
    add_grey_textures(fixture);
    return fixture;
}

nlohmann::json texture(int index)
{
    return {{"index", index}};
}

}  // namespace

TEST_CASE("clearcoat is read")
{
    const LoadedScene loaded =
        with_extension(
            "KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.75},
             {"clearcoatTexture", texture(1)},
             {"clearcoatRoughnessFactor", 0.25},
             {"clearcoatRoughnessTexture", texture(2)},
             {"clearcoatNormalTexture", {{"index", 3}, {"scale", 0.5}, {"texCoord", 1}}}})
            .load();
    CHECK(loaded.warnings.empty());
    const ClearcoatDesc& coat = loaded.scene.materials.at(0).clearcoat;
    CHECK(coat.factor == 0.75f);
    CHECK(coat.roughness == 0.25f);
    CHECK(coat.normal_scale == 0.5f);
    CHECK(grey_image(loaded, coat.texture) == 1);
    CHECK(grey_image(loaded, coat.roughness_texture) == 2);
    CHECK(grey_image(loaded, coat.normal_texture) == 3);
    CHECK(coat.normal_texture->uv_set == 1);
}

TEST_CASE("a coat is read, as a draft, and replaces a clearcoat")
{
    GltfFixture fixture =
        with_extension("KHR_materials_coat", {{"coatFactor", 0.75},
                                              {"coatTexture", texture(1)},
                                              {"coatRoughnessFactor", 0.25},
                                              {"coatRoughnessTexture", texture(2)},
                                              {"coatNormalTexture", {{"index", 3}, {"scale", 0.5}}},
                                              {"coatIor", 1.75},
                                              {"coatColorFactor", {1, 0.5, 0.25}},
                                              {"coatColorTexture", texture(4)},
                                              {"coatDarkeningFactor", 0.5},
                                              {"coatAnisotropyStrength", 0.25},
                                              {"coatAnisotropyRotation", -1.5},
                                              {"coatAnisotropyTexture", texture(5)}});
    fixture.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", 1}};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.warnings.empty());
    CHECK(loaded.notes.size() == 1);
    CHECK(loaded.scene.materials.at(0).clearcoat.factor == 0.0f);
    const CoatDesc& coat = loaded.scene.materials.at(0).coat;
    CHECK(coat.factor == 0.75f);
    CHECK(coat.roughness == 0.25f);
    CHECK(coat.normal_scale == 0.5f);
    CHECK(coat.ior == 1.75f);
    CHECK(coat.color == Rgb(1.0f, 0.5f, 0.25f));
    CHECK(coat.darkening == 0.5f);
    CHECK(coat.anisotropy_strength == 0.25f);
    CHECK(coat.anisotropy_rotation == -1.5f);
    CHECK(grey_image(loaded, coat.texture) == 1);
    CHECK(grey_image(loaded, coat.roughness_texture) == 2);
    CHECK(grey_image(loaded, coat.normal_texture) == 3);
    CHECK(grey_image(loaded, coat.color_texture) == 4);
    CHECK(grey_image(loaded, coat.anisotropy_texture) == 5);
    const LoadedScene defaults = with_extension("KHR_materials_coat", {{"coatFactor", 1}}).load();
    CHECK(defaults.scene.materials.at(0).coat.ior == 1.5f);
    CHECK(defaults.scene.materials.at(0).coat.color == Rgb(1.0f));
    CHECK(defaults.scene.materials.at(0).coat.darkening == 1.0f);
    // One that is switched off does not even tint, and is no reason for the fallback.
    const LoadedScene none = with_extension("KHR_materials_coat", {{"coatColorFactor", {1, 0, 0}},
                                                                   {"coatTexture", texture(1)}})
                                 .load();
    CHECK(none.scene.materials.at(0).coat.factor == 0.0f);
    CHECK(none.scene.images.empty());
    // An index of 0 stands for total reflection, others below 1 are impossible.
    CHECK(with_extension("KHR_materials_coat", {{"coatFactor", 1}, {"coatIor", 0}})
              .load()
              .scene.materials.at(0)
              .coat.ior > 1e6f);
    const LoadedScene low =
        with_extension("KHR_materials_coat", {{"coatFactor", 1}, {"coatIor", 0.5}}).load();
    CHECK(low.scene.materials.at(0).coat.ior == 1.0f);
    CHECK(low.warnings.size() == 1);
}

TEST_CASE("layers that exclude specular-glossiness are used with it, with a warning")
{
    for (const auto& [name, factor] : {std::pair{"KHR_materials_coat", "coatFactor"},
                                       std::pair{"KHR_materials_fuzz", "fuzzFactor"}}) {
        GltfFixture fixture = with_extension(name, {{factor, 1}});
        fixture.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] =
            nlohmann::json::object();
        fixture.json["extensionsUsed"].push_back("KHR_materials_pbrSpecularGlossiness");
        const LoadedScene loaded = fixture.load();
        REQUIRE(loaded.warnings.size() == 1);
        CHECK(loaded.warnings[0].find(": " + std::string(name) + " must not be combined") !=
              std::string::npos);
        const MaterialDesc& material = loaded.scene.materials.at(0);
        CHECK(material.coat.factor + material.fuzz.factor == 1.0f);
        CHECK(material.specular_color == Rgb(25.0f));
    }
}

TEST_CASE("a coat that is not there has no images")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_clearcoat", {{"clearcoatTexture", texture(1)},
                                                   {"clearcoatRoughnessTexture", texture(2)}})
            .load();
    CHECK(loaded.scene.materials.at(0).clearcoat.factor == 0.0f);
    CHECK(loaded.scene.images.empty());
    // A smooth coat stays smooth under any texture.
    const LoadedScene smooth =
        with_extension("KHR_materials_clearcoat",
                       {{"clearcoatFactor", 1}, {"clearcoatRoughnessTexture", texture(2)}})
            .load();
    CHECK(smooth.scene.images.empty());
}

TEST_CASE("sheen is read")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_sheen", {{"sheenColorFactor", {0.75, 0.5, 0.25}},
                                               {"sheenColorTexture", texture(1)},
                                               {"sheenRoughnessFactor", 0.25},
                                               {"sheenRoughnessTexture", texture(2)}})
            .load();
    CHECK(loaded.warnings.empty());
    const SheenDesc& sheen = loaded.scene.materials.at(0).sheen;
    CHECK(sheen.color == Rgb(0.75f, 0.5f, 0.25f));
    CHECK(sheen.roughness == 0.25f);
    CHECK(grey_image(loaded, sheen.color_texture) == 1);
    CHECK(grey_image(loaded, sheen.roughness_texture) == 2);
    const LoadedScene none =
        with_extension("KHR_materials_sheen", {{"sheenColorTexture", texture(1)}}).load();
    CHECK(none.scene.materials.at(0).sheen.color == Rgb(0.0f));
    CHECK(none.scene.images.empty());
}

TEST_CASE("fuzz is read, as a draft, and replaces a sheen")
{
    GltfFixture fixture =
        with_extension("KHR_materials_fuzz", {{"fuzzFactor", 0.5},
                                              {"fuzzTexture", texture(1)},
                                              {"fuzzColorFactor", {0.75, 0.5, 0.25}},
                                              {"fuzzColorTexture", texture(2)},
                                              {"fuzzRoughnessFactor", 0.25},
                                              {"fuzzRoughnessTexture", texture(3)}});
    fixture.json["materials"][0]["extensions"]["KHR_materials_sheen"] = {
        {"sheenColorFactor", {1, 1, 1}}};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.warnings.empty());
    CHECK(loaded.notes.size() == 1);
    const MaterialDesc& material = loaded.scene.materials.at(0);
    CHECK(material.sheen.color == Rgb(0.0f));
    CHECK(material.fuzz.factor == 0.5f);
    CHECK(material.fuzz.color == Rgb(0.75f, 0.5f, 0.25f));
    CHECK(material.fuzz.roughness == 0.25f);
    CHECK(grey_image(loaded, material.fuzz.texture) == 1);
    CHECK(grey_image(loaded, material.fuzz.color_texture) == 2);
    CHECK(grey_image(loaded, material.fuzz.roughness_texture) == 3);
    const LoadedScene defaults = with_extension("KHR_materials_fuzz", {{"fuzzFactor", 1}}).load();
    CHECK(defaults.scene.materials.at(0).fuzz.color == Rgb(1.0f));
    CHECK(defaults.scene.materials.at(0).fuzz.roughness == 0.5f);
    const LoadedScene none =
        with_extension("KHR_materials_fuzz", {{"fuzzTexture", texture(1)}}).load();
    CHECK(none.scene.materials.at(0).fuzz.factor == 0.0f);
    CHECK(none.scene.images.empty());
}

TEST_CASE("anisotropy is read")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_anisotropy", {{"anisotropyStrength", 0.75},
                                                    {"anisotropyRotation", -1.5},
                                                    {"anisotropyTexture", texture(1)}})
            .load();
    CHECK(loaded.warnings.empty());
    const AnisotropyDesc& anisotropy = loaded.scene.materials.at(0).anisotropy;
    CHECK(anisotropy.strength == 0.75f);
    CHECK(anisotropy.rotation == -1.5f);
    CHECK(grey_image(loaded, anisotropy.texture) == 1);
}

TEST_CASE("iridescence is read")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_iridescence", {{"iridescenceFactor", 0.5},
                                                     {"iridescenceIor", 1.75},
                                                     {"iridescenceThicknessMinimum", 200},
                                                     {"iridescenceThicknessMaximum", 800},
                                                     {"iridescenceTexture", texture(1)},
                                                     {"iridescenceThicknessTexture", texture(2)}})
            .load();
    CHECK(loaded.warnings.empty());
    const IridescenceDesc& film = loaded.scene.materials.at(0).iridescence;
    CHECK(film.factor == 0.5f);
    CHECK(film.ior == 1.75f);
    CHECK(film.thickness_minimum == 200.0f);
    CHECK(film.thickness_maximum == 800.0f);
    CHECK(grey_image(loaded, film.texture) == 1);
    CHECK(grey_image(loaded, film.thickness_texture) == 2);
    const LoadedScene defaults =
        with_extension("KHR_materials_iridescence", {{"iridescenceFactor", 1}}).load();
    CHECK(defaults.scene.materials.at(0).iridescence.ior == 1.3f);
    CHECK(defaults.scene.materials.at(0).iridescence.thickness_minimum == 100.0f);
    CHECK(defaults.scene.materials.at(0).iridescence.thickness_maximum == 400.0f);
}

TEST_CASE("diffuse transmission is read")
{
    const LoadedScene loaded = with_extension("KHR_materials_diffuse_transmission",
                                              {{"diffuseTransmissionFactor", 0.5},
                                               {"diffuseTransmissionColorFactor", {0.25, 0.5, 1}},
                                               {"diffuseTransmissionTexture", texture(1)},
                                               {"diffuseTransmissionColorTexture", texture(2)}})
                                   .load();
    CHECK(loaded.warnings.empty());
    const DiffuseTransmissionDesc& through = loaded.scene.materials.at(0).diffuse_transmission;
    CHECK(through.factor == 0.5f);
    CHECK(through.color == Rgb(0.25f, 0.5f, 1.0f));
    CHECK(grey_image(loaded, through.texture) == 1);
    CHECK(grey_image(loaded, through.color_texture) == 2);
}

TEST_CASE("diffuse roughness is read, as a draft")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_diffuse_roughness",
                       {{"diffuseRoughnessFactor", 0.75}, {"diffuseRoughnessTexture", texture(1)}})
            .load();
    CHECK(loaded.warnings.empty());
    CHECK(loaded.notes.size() == 1);
    const DiffuseRoughnessDesc& rough = loaded.scene.materials.at(0).diffuse_roughness;
    CHECK(rough.factor == 0.75f);
    CHECK(grey_image(loaded, rough.texture) == 1);
    const LoadedScene smooth =
        with_extension("KHR_materials_diffuse_roughness", {{"diffuseRoughnessTexture", texture(1)}})
            .load();
    CHECK(smooth.scene.materials.at(0).diffuse_roughness.factor == 0.0f);
}

TEST_CASE("specular-glossiness becomes a dielectric with a specular colour")
{
    GltfFixture fixture = with_extension("KHR_materials_pbrSpecularGlossiness",
                                         {{"diffuseFactor", {0.25, 0.5, 0.75, 0.5}},
                                          {"specularFactor", {1, 0.5, 0.25}},
                                          {"glossinessFactor", 0.75},
                                          {"diffuseTexture", texture(1)},
                                          {"specularGlossinessTexture", texture(2)}});
    // What viewers without the extension see does not count.
    fixture.json["materials"][0]["pbrMetallicRoughness"] = {
        {"metallicFactor", 1}, {"metallicRoughnessTexture", texture(3)}};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.warnings.empty());
    const MaterialDesc& material = loaded.scene.materials.at(0);
    CHECK(material.base_color == Vec4(0.25f, 0.5f, 0.75f, 0.5f));
    CHECK(material.metallic == 0.0f);
    CHECK(material.roughness == 0.25f);
    CHECK(material.specular == 1.0f);
    // Times 0.04, the reflectance of index 1.5.
    CHECK(material.specular_color.r == Approx(25.0));
    CHECK(material.specular_color.b == Approx(6.25));
    CHECK(grey_image(loaded, material.base_color_texture) == 1);
    CHECK(grey_image(loaded, material.specular_color_texture) == 2);
    CHECK(grey_image(loaded, material.glossiness_texture) == 2);
    CHECK_FALSE(material.metallic_roughness_texture);
    const MaterialDesc defaults =
        with_extension("KHR_materials_pbrSpecularGlossiness", nlohmann::json::object())
            .load()
            .scene.materials.at(0);
    CHECK(defaults.base_color == Vec4(1.0f));
    CHECK(defaults.roughness == 0.0f);
    CHECK(defaults.specular_color.g == Approx(25.0));
}

TEST_CASE("dispersion is read")
{
    const auto dispersion = [](const nlohmann::json& extension) {
        return with_extension("KHR_materials_dispersion", extension)
            .load()
            .scene.materials.at(0)
            .dispersion;
    };
    CHECK(dispersion({{"dispersion", 2.5}}) == 2.5f);
    CHECK(dispersion(nlohmann::json::object()) == 0.0f);
    CHECK(dispersion({{"dispersion", -1}}) == 0.0f);
}

TEST_CASE("values of layers beyond their ranges are brought back, of a wrong type refused")
{
    const LoadedScene loaded =
        with_extension("KHR_materials_clearcoat", {{"clearcoatFactor", 1.5}}).load();
    CHECK(loaded.scene.materials.at(0).clearcoat.factor == 1.0f);
    CHECK(warns(loaded.warnings,
                {"/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor: 1.5"}));
    const Error error =
        with_extension("KHR_materials_clearcoat", {{"clearcoatFactor", "much"}}).error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(),
                   "/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor: must be"));
}

TEST_CASE("each property of an extension must have its type")
{
    struct Property {
        std::string extension;
        std::string name;
        std::string right_type = "a number";
    };
    const Property properties[] = {
        {"anisotropy", "anisotropyStrength"},
        {"anisotropy", "anisotropyRotation"},
        {"clearcoat", "clearcoatFactor"},
        {"clearcoat", "clearcoatRoughnessFactor"},
        {"diffuse_roughness", "diffuseRoughnessFactor"},
        {"fuzz", "fuzzFactor"},
        {"coat", "coatFactor"},
        {"diffuse_transmission", "diffuseTransmissionFactor"},
        {"diffuse_transmission", "diffuseTransmissionColorFactor", "3 numbers"},
        {"dispersion", "dispersion"},
        {"emissive_strength", "emissiveStrength"},
        {"ior", "ior"},
        {"iridescence", "iridescenceFactor"},
        {"iridescence", "iridescenceIor"},
        {"iridescence", "iridescenceThicknessMinimum"},
        {"iridescence", "iridescenceThicknessMaximum"},
        {"pbrSpecularGlossiness", "diffuseFactor", "4 numbers"},
        {"pbrSpecularGlossiness", "specularFactor", "3 numbers"},
        {"pbrSpecularGlossiness", "glossinessFactor"},
        {"scatter", "scatterStrengthFactor"},
        {"scatter", "multiscatterColorFactor", "3 numbers"},
        {"scatter", "scatterAnisotropy"},
        {"sheen", "sheenColorFactor", "3 numbers"},
        {"sheen", "sheenRoughnessFactor"},
        {"specular", "specularFactor"},
        {"specular", "specularColorFactor", "3 numbers"},
        {"transmission", "transmissionFactor"},
        {"volume", "thicknessFactor"},
        {"volume", "attenuationDistance"},
        {"volume", "attenuationColor", "3 numbers"},
        {"volume_scatter", "scatterAnisotropy"},
        {"volume_scatter", "multiscatterColor", "3 numbers"},
        {"volume_scatter", "multiscatterColorFactor", "3 numbers"},
    };
    for (const Property& property : properties) {
        const std::string extension = "KHR_materials_" + property.extension;
        for (const nlohmann::json& value : {nlohmann::json("much"), nlohmann::json({0.5, 0.5})}) {
            CAPTURE(property.name, value.dump());
            const Error error = with_extension(extension, {{property.name, value}}).error();
            CHECK(error.code() == ErrorCode::invalid_input);
            CHECK(contains(error.what(), "/materials/0/extensions/" + extension + "/" +
                                             property.name + ": must be " + property.right_type));
        }
    }
    const Error error =
        with_extension("KHR_materials_clearcoat",
                       {{"clearcoatNormalTexture", {{"index", 0}, {"scale", "much"}}}})
            .error();
    CHECK(contains(error.what(), "clearcoatNormalTexture/scale: must be a number"));
}

}  // namespace bdpt::test::material_layers_test
