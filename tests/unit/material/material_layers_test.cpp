#include "material/material.h"
#include "material/medium.h"

#include "catch.hpp"
#include "math/rgb.h"

#include <cmath>
#include <functional>
#include <vector>

namespace bdpt::test::material_layers_test {
namespace {

constexpr TextureRef first_image{};

/// One texel.
TexelImage texel(std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a)
{
    return {1, 1, {r, g, b, a}};
}

MaterialDesc dark_plastic()
{
    MaterialDesc desc;
    desc.base_color = {0.2f, 0.1f, 0.05f, 1.0f};
    desc.metallic = 0.0f;
    desc.roughness = 0.5f;
    return desc;
}

const Vec3 slanted = normalize(Vec3{0.5f, 0.2f, 0.6f});
const Vec3 ahead = normalize(Vec3{-0.3f, 0.4f, 0.7f});

/// What a material scatters from one direction into another, at a point with a tangent along x.
Rgb scattered(const MaterialDesc& desc, const std::vector<TexelImage>& images = {},
              Vec4 tangent = {1.0f, 0.0f, 0.0f, 1.0f}, Vec3 wi = ahead)
{
    const SpecularAlbedo albedo(desc.ior);
    const LayerTables tables({&desc, 1});
    const Material material(desc, images, albedo, &tables);
    return material.bsdf({.tangent = tangent, .wo = slanted})
        .eval(wi, TransportMode::radiance)
        .f_cos;
}

void check_equal(Rgb a, Rgb b)
{
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(a[channel] == Approx(b[channel]).epsilon(1e-3));
    }
}

float srgb(double encoded)
{
    return static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
}

/// The image is worth as much as the factors that `same` has.
void check_texture(const MaterialDesc& textured, const MaterialDesc& same, const TexelImage& image)
{
    check_equal(scattered(textured, {image}), scattered(same));
    CHECK(scattered(textured, {image}) != scattered(textured, {texel(255, 255, 255, 255)}));
}

}  // namespace

TEST_CASE("a coat is red of its texture, its roughness green")
{
    MaterialDesc textured = dark_plastic();
    textured.clearcoat.factor = 0.5f;
    textured.clearcoat.roughness = 0.5f;
    MaterialDesc same = textured;
    textured.clearcoat.texture = first_image;
    same.clearcoat.factor = 0.2f;
    check_texture(textured, same, texel(102, 255, 255, 255));
    textured.clearcoat.texture.reset();
    textured.clearcoat.roughness_texture = first_image;
    same.clearcoat.factor = 0.5f;
    same.clearcoat.roughness = 0.4f;
    check_texture(textured, same, texel(255, 204, 255, 255));
}

TEST_CASE("the normal map of the base does not bend the coat, its own does")
{
    // A black base: all that is seen is the coat.
    MaterialDesc even = dark_plastic();
    even.base_color = {0.0f, 0.0f, 0.0f, 1.0f};
    even.specular = 0.0f;
    even.clearcoat.factor = 1.0f;
    even.clearcoat.roughness = 0.5f;
    const std::vector<TexelImage> slope{texel(204, 153, 230, 255)};
    MaterialDesc bumpy_base = even;
    bumpy_base.normal_texture = first_image;
    // f_cos has the cosine to the coat's normal, and does not change with that of the base.
    check_equal(scattered(bumpy_base, slope), scattered(even));
    MaterialDesc bumpy_coat = even;
    bumpy_coat.clearcoat.normal_texture = first_image;
    CHECK(scattered(bumpy_coat, slope).g != Approx(scattered(even).g).epsilon(0.1));
    // Bent alike the two are one surface.
    MaterialDesc bumpy = bumpy_base;
    bumpy.clearcoat.normal_texture = first_image;
    check_equal(scattered(bumpy, slope), scattered(bumpy_coat, slope));
    bumpy_coat.clearcoat.normal_scale = 0.0f;
    check_equal(scattered(bumpy_coat, slope), scattered(even));
}

TEST_CASE("a clearcoat is a coat that neither darkens nor blurs its base")
{
    MaterialDesc clear = dark_plastic();
    clear.clearcoat.factor = 0.7f;
    clear.clearcoat.roughness = 0.4f;
    MaterialDesc coat = dark_plastic();
    coat.coat.factor = 0.7f;
    coat.coat.roughness = 0.4f;
    coat.coat.darkening = 0.0f;
    // The blurred base has the roughness (0.5^4 + 2 0.4^4)^(1/4), for the share of the coat.
    MaterialDesc blurred = clear;
    blurred.roughness = 0.5f + 0.7f * (std::pow(0.0625f + 2.0f * 0.0256f, 0.25f) - 0.5f);
    check_equal(scattered(coat), scattered(blurred));
    CHECK(scattered(coat).g != Approx(scattered(clear).g).epsilon(0.01));
    // It replaces the clearcoat.
    coat.clearcoat.factor = 1.0f;
    check_equal(scattered(coat), scattered(blurred));
    coat.coat.darkening = 1.0f;
    CHECK(scattered(coat).r < 0.97f * scattered(blurred).r);
    coat.coat.ior = 2.0f;
    const LayerTables tables({&coat, 1});
    CHECK(tables.are_enough_for({&coat, 1}));
    CHECK(!tables.are_enough_for({&clear, 1}));
}

TEST_CASE("a coat has an sRGB colour, and a direction and a strength of its anisotropy")
{
    MaterialDesc textured = dark_plastic();
    textured.coat.factor = 1.0f;
    textured.coat.roughness = 0.3f;
    textured.coat.color = {1.0f, 0.5f, 0.25f};
    MaterialDesc same = textured;
    textured.coat.color_texture = first_image;
    same.coat.color = {srgb(0.4), 0.5f * srgb(0.6), 0.25f * srgb(0.8)};
    check_texture(textured, same, texel(102, 153, 204, 255));
    textured.coat.color_texture.reset();
    textured.coat.texture = first_image;
    same.coat.color = textured.coat.color;
    same.coat.factor = 0.4f;
    check_texture(textured, same, texel(102, 255, 255, 255));
    textured.coat.texture.reset();
    textured.coat.roughness_texture = first_image;
    same.coat.factor = 1.0f;
    same.coat.roughness = 0.12f;
    check_texture(textured, same, texel(255, 102, 255, 255));
    textured.coat.roughness_texture.reset();
    textured.coat.anisotropy_strength = 0.8f;
    textured.coat.anisotropy_rotation = 0.6f;
    same = textured;
    const Rgb turned = scattered(textured, {}, {1.0f, 0.0f, 0.0f, 1.0f});
    same.coat.anisotropy_rotation = 0.0f;
    const Rgb along_tangent = scattered(same, {}, {std::cos(0.6f), std::sin(0.6f), 0.0f, 1.0f});
    for (int c = 0; c < 3; ++c) {
        CHECK(turned[c] == Approx(along_tangent[c]).epsilon(0.01));
    }
    CHECK(scattered(same).g != Approx(turned.g).epsilon(0.05));
    textured.coat.anisotropy_texture = first_image;
    same = textured;
    same.coat.anisotropy_texture.reset();
    same.coat.anisotropy_strength = 0.4f;
    const Rgb mapped = scattered(textured, {texel(255, 128, 128, 255)});
    for (int c = 0; c < 3; ++c) {
        CHECK(mapped[c] == Approx(scattered(same)[c]).epsilon(0.02));
    }
}

TEST_CASE("sheen has an sRGB colour and a roughness in alpha")
{
    MaterialDesc textured = dark_plastic();
    textured.sheen.color = {1.0f, 0.5f, 0.25f};
    textured.sheen.roughness = 0.5f;
    MaterialDesc same = textured;
    textured.sheen.color_texture = first_image;
    same.sheen.color = {srgb(0.4), 0.5f * srgb(0.6), 0.25f * srgb(0.8)};
    check_texture(textured, same, texel(102, 153, 204, 255));
    textured.sheen.color_texture.reset();
    textured.sheen.roughness_texture = first_image;
    same.sheen.color = textured.sheen.color;
    same.sheen.roughness = 0.4f;
    check_texture(textured, same, texel(255, 255, 255, 204));
}

TEST_CASE("fuzz is red of its texture, its colour sRGB, its roughness alpha")
{
    MaterialDesc textured = dark_plastic();
    textured.fuzz.factor = 0.8f;
    textured.fuzz.color = {1.0f, 0.5f, 0.25f};
    textured.fuzz.roughness = 0.5f;
    MaterialDesc same = textured;
    textured.fuzz.texture = first_image;
    same.fuzz.factor = 0.32f;
    check_texture(textured, same, texel(102, 255, 255, 255));
    textured.fuzz.texture.reset();
    textured.fuzz.color_texture = first_image;
    same.fuzz.factor = 0.8f;
    same.fuzz.color = {srgb(0.4), 0.5f * srgb(0.6), 0.25f * srgb(0.8)};
    check_texture(textured, same, texel(102, 153, 204, 255));
    textured.fuzz.color_texture.reset();
    textured.fuzz.roughness_texture = first_image;
    same.fuzz.color = textured.fuzz.color;
    same.fuzz.roughness = 0.4f;
    check_texture(textured, same, texel(255, 255, 255, 204));
    // It replaces a sheen, of which it is the general case.
    MaterialDesc sheen = dark_plastic();
    sheen.sheen.color = {0.8f, 0.4f, 0.2f};
    sheen.sheen.roughness = 0.5f;
    same.fuzz.roughness = 0.5f;
    check_equal(scattered(same), scattered(sheen));
    sheen.fuzz = same.fuzz;
    sheen.sheen.color = Rgb(1.0f);
    check_equal(scattered(same), scattered(sheen));
}

TEST_CASE("fuzz covers a coat, and a coat covers a sheen")
{
    // Black dust takes from the reflection of the coat above which it is.
    MaterialDesc fuzz;
    fuzz.base_color = {0.0f, 0.0f, 0.0f, 1.0f};
    fuzz.metallic = 0.0f;
    fuzz.specular = 0.0f;
    fuzz.clearcoat.factor = 1.0f;
    fuzz.clearcoat.roughness = 0.5f;
    const Rgb coat = scattered(fuzz);
    MaterialDesc sheen = fuzz;
    fuzz.fuzz.factor = 1.0f;
    fuzz.fuzz.color = Rgb(0.0f);
    fuzz.fuzz.roughness = 1.0f;
    CHECK(scattered(fuzz).g < 0.7f * coat.g);
    sheen.sheen.color = Rgb(0.2f);
    sheen.sheen.roughness = 1.0f;
    CHECK(scattered(sheen).g > coat.g);
}

TEST_CASE("grooves follow the tangent, their rotation and their texture")
{
    MaterialDesc desc = dark_plastic();
    desc.metallic = 1.0f;
    desc.anisotropy.strength = 0.8f;
    const Rgb along_x = scattered(desc);
    const Rgb along_y = scattered(desc, {}, {0.0f, 2.0f, 0.0f, 1.0f});
    CHECK(along_x.r != Approx(along_y.r).epsilon(0.1));
    // Counter-clockwise from the tangent to the bitangent.
    MaterialDesc turned = desc;
    turned.anisotropy.rotation = 0.6f;
    check_equal(scattered(turned),
                scattered(desc, {}, {std::cos(0.6f), std::sin(0.6f), 0.0f, 1.0f}));
    check_equal(scattered(turned, {}, {1.0f, 0.0f, 0.0f, -1.0f}),
                scattered(desc, {}, {std::cos(0.6f), -std::sin(0.6f), 0.0f, 1.0f}));
    // Red and green are a direction, which the rotation turns further; blue is the strength.
    MaterialDesc mapped = turned;
    mapped.anisotropy.texture = first_image;
    MaterialDesc same = desc;
    same.anisotropy.strength = 0.8f * 128.0f / 255.0f;
    const float angle =
        0.6f + std::atan2(2.0f * 204.0f / 255.0f - 1.0f, 2.0f * 230.0f / 255.0f - 1.0f);
    check_equal(scattered(mapped, {texel(230, 204, 128, 255)}),
                scattered(same, {}, {std::cos(angle), std::sin(angle), 0.0f, 1.0f}));
    // Without a direction highlights are round.
    MaterialDesc round = desc;
    round.anisotropy.strength = 0.0f;
    check_equal(scattered(desc, {}, Vec4(0.0f)), scattered(round));
    const SpecularAlbedo albedo(1.5f);
    const LayerTables tables({&desc, 1});
    CHECK(Material(desc, {}, albedo, &tables).tangent_uv_set() == 0);
}

TEST_CASE("a film is red of its texture, its thickness green between two bounds")
{
    MaterialDesc textured = dark_plastic();
    textured.iridescence.factor = 0.5f;
    textured.iridescence.ior = 2.0f;
    textured.iridescence.thickness_minimum = 100.0f;
    textured.iridescence.thickness_maximum = 350.0f;
    MaterialDesc same = textured;
    textured.iridescence.texture = first_image;
    same.iridescence.factor = 0.2f;
    check_texture(textured, same, texel(102, 255, 255, 255));
    textured.iridescence.texture.reset();
    textured.iridescence.thickness_texture = first_image;
    same.iridescence.factor = 0.5f;
    same.iridescence.thickness_maximum = 100.0f + 0.4f * 250.0f;
    check_texture(textured, same, texel(255, 102, 255, 255));
}

TEST_CASE("diffuse transmission is alpha of its texture, its colour sRGB, its inside absorbs")
{
    MaterialDesc textured = dark_plastic();
    textured.diffuse_transmission.factor = 0.5f;
    textured.diffuse_transmission.color = {1.0f, 0.5f, 0.25f};
    MaterialDesc same = textured;
    const auto both_sides = [](const MaterialDesc& desc, const TexelImage& image) {
        return scattered(desc, {image}) +
               scattered(desc, {image}, {1.0f, 0.0f, 0.0f, 1.0f}, -slanted);
    };
    textured.diffuse_transmission.texture = first_image;
    same.diffuse_transmission.factor = 0.2f;
    check_equal(both_sides(textured, texel(255, 255, 255, 102)), both_sides(same, {}));
    textured.diffuse_transmission.texture.reset();
    textured.diffuse_transmission.color_texture = first_image;
    same.diffuse_transmission.factor = 0.5f;
    same.diffuse_transmission.color = {srgb(0.4), 0.5f * srgb(0.6), 0.25f * srgb(0.8)};
    check_equal(both_sides(textured, texel(102, 153, 204, 255)), both_sides(same, {}));

    same.attenuation_color = Rgb(0.5f);
    same.attenuation_distance = 2.0f;
    CHECK(medium_within(same).is_clear());
    same.thickness = 1.0f;
    CHECK(medium_within(same).extinction.g == Approx(std::log(2.0) / 2.0));
}

TEST_CASE("unlit materials have no layers, and layers of factor 0 are none")
{
    MaterialDesc desc = dark_plastic();
    CHECK(!has_layers(desc));
    const std::vector<std::function<void(MaterialDesc&)>> changes{
        [](MaterialDesc& d) { d.clearcoat.factor = 0.1f; },
        [](MaterialDesc& d) { d.coat.factor = 0.1f; },
        [](MaterialDesc& d) { d.sheen.color.b = 0.1f; },
        [](MaterialDesc& d) { d.fuzz.factor = 0.1f; },
        [](MaterialDesc& d) { d.anisotropy.strength = 0.1f; },
        [](MaterialDesc& d) { d.iridescence.factor = 0.1f; },
        [](MaterialDesc& d) { d.diffuse_transmission.factor = 0.1f; },
        [](MaterialDesc& d) { d.diffuse_roughness.factor = 0.1f; }};
    for (const auto& change : changes) {
        MaterialDesc changed = desc;
        change(changed);
        CHECK(has_layers(changed));
        changed.unlit = true;
        CHECK(!has_layers(changed));
    }
}

}  // namespace bdpt::test::material_layers_test
