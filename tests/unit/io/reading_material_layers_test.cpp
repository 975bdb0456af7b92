#include "catch.hpp"
#include "gltf_fixture.h"
#include "picture_fixture.h"

#include <bdpt/scene_desc.h>

using namespace bdpt;
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
    for (int i = 0; i < 6; ++i) {
        fixture.json["images"].push_back(
            {{"uri", "data:image/png;base64," + base64(png(1, 1, 8, 0, {raw({10 * i})}))}});
        fixture.json["textures"].push_back({{"source", i}});
    }
    return fixture;
}

/// Which of these pictures a reference leads to; -1: none.
int picture(const LoadedScene& loaded, const std::optional<TextureRef>& ref)
{
    if (!ref) {
        return -1;
    }
    return loaded.scene.images.at(static_cast<std::size_t>(ref->image)).rgba.at(0) / 10;
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
    CHECK(picture(loaded, coat.texture) == 1);
    CHECK(picture(loaded, coat.roughness_texture) == 2);
    CHECK(picture(loaded, coat.normal_texture) == 3);
    CHECK(coat.normal_texture->uv_set == 1);
}

TEST_CASE("a coat that is not there has no pictures")
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
    CHECK(picture(loaded, sheen.color_texture) == 1);
    CHECK(picture(loaded, sheen.roughness_texture) == 2);
    const LoadedScene none =
        with_extension("KHR_materials_sheen", {{"sheenColorTexture", texture(1)}}).load();
    CHECK(none.scene.materials.at(0).sheen.color == Rgb(0.0f));
    CHECK(none.scene.images.empty());
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
