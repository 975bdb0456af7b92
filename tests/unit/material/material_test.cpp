#include "material/material.h"
#include "material/medium.h"

#include "catch.hpp"
#include "math/elementary.h"
#include "math/rgb.h"

#include <cmath>

namespace bdpt::test::material_test {
namespace {

constexpr TextureRef first_image{};

/// A description of a Lambertian surface: what it scatters shows the base colour.
MaterialDesc lambert()
{
    MaterialDesc desc;
    desc.metallic = 0.0f;
    desc.specular = 0.0f;
    return desc;
}

/// One texel.
TexelImage texel(std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a)
{
    return {1, 1, {r, g, b, a}};
}

/// f_cos towards `wi`, seen straight from above where the point does not say otherwise.
Rgb scattered(const Bsdf& bsdf, Vec3 wi = {0.0f, 0.0f, 1.0f})
{
    return bsdf.eval(wi, TransportMode::radiance).f_cos;
}

void check_equal(Rgb a, Rgb b)
{
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(a[channel] == Approx(b[channel]).epsilon(1e-4));
    }
}

float srgb(double encoded)
{
    return static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
}

/// What the same surface without textures would scatter.
Rgb expected(const GltfParameters& surface, const SpecularAlbedo& albedo)
{
    const Vec3 up{0.0f, 0.0f, 1.0f};
    return MetallicRoughness(surface, albedo).eval(up, up, TransportMode::radiance).f_cos;
}

}  // namespace

TEST_CASE("base colour is factor times vertex colour times sRGB texture")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(102, 153, 204, 255)};
    MaterialDesc desc = lambert();
    desc.base_color = {0.5f, 0.25f, 1.0f, 1.0f};
    desc.base_color_texture = first_image;
    const Material material(desc, images, albedo);
    const ShadingPoint point{.color = {1.0f, 0.5f, 0.25f, 1.0f}};
    check_equal(scattered(material.bsdf(point)),
                Rgb{0.5f * srgb(0.4), 0.125f * srgb(0.6), 0.25f * srgb(0.8)} * inv_pi);
}

TEST_CASE("metallic is blue and roughness green of a linear texture")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(7, 204, 102, 0)};
    MaterialDesc desc;
    desc.base_color = {0.9f, 0.6f, 0.3f, 1.0f};
    desc.metallic = 0.5f;
    desc.roughness = 0.75f;
    desc.metallic_roughness_texture = first_image;
    const Material material(desc, images, albedo);
    check_equal(
        scattered(material.bsdf({})),
        expected({.base_color = {0.9f, 0.6f, 0.3f}, .metallic = 0.2f, .roughness = 0.6f}, albedo));
}

TEST_CASE("specular is alpha of its texture, its colour is sRGB")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(255, 255, 255, 51), texel(102, 153, 204, 0)};
    MaterialDesc desc;
    desc.metallic = 0.0f;
    desc.roughness = 0.5f;
    desc.specular = 0.5f;
    desc.specular_color = {1.0f, 1.0f, 0.5f};
    desc.specular_texture = first_image;
    desc.specular_color_texture = TextureRef{.image = ImageId{1}};
    const Material material(desc, images, albedo);
    check_equal(scattered(material.bsdf({})),
                expected({.roughness = 0.5f,
                          .specular = 0.1f,
                          .specular_color = {srgb(0.4), srgb(0.6), 0.5f * srgb(0.8)}},
                         albedo));
}

TEST_CASE("glossiness is alpha of a linear texture, and smooth where it is 1")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(0, 0, 0, 204)};
    MaterialDesc desc;
    desc.metallic = 0.0f;
    desc.roughness = 0.25f;
    desc.glossiness_texture = first_image;
    const Material material(desc, images, albedo);
    // 1 - 0.75 * 0.8
    check_equal(scattered(material.bsdf({})), expected({.roughness = 0.4f}, albedo));
}

TEST_CASE("only solid transmitters disperse, red least")
{
    MaterialDesc desc;
    desc.ior = 1.6f;
    desc.dispersion = 2.0f;
    desc.transmission = 1.0f;
    CHECK(channel_indices(desc)[2] == 1.6f);
    desc.thickness = 1.0f;
    const auto [red, green, blue] = channel_indices(desc);
    CHECK(red == Approx(1.57));
    CHECK(green == 1.6f);
    CHECK(blue == Approx(1.63));
    desc.dispersion = 100.0f;
    CHECK(channel_indices(desc)[0] == 1.0f);

    desc.roughness = 0.5f;
    desc.metallic = 0.0f;
    const SpecularAlbedo low(1.5f);
    const SpecularAlbedo middle(1.6f);
    const SpecularAlbedo high(1.7f);
    CHECK(!Material(desc, {}, middle).disperses());
    const Material material(desc, {}, {low, middle, high});
    CHECK(material.disperses());
    const Vec3 down{0.0f, 0.0f, -1.0f};
    const auto seen = [&](Wavelength wavelength) {
        return scattered(material.bsdf({.wavelength = wavelength}), down);
    };
    check_equal(seen(Wavelength::red), scattered(Material(desc, {}, low).bsdf({}), down));
    check_equal(seen(Wavelength::green), scattered(Material(desc, {}, middle).bsdf({}), down));
    check_equal(seen(Wavelength::blue), scattered(Material(desc, {}, high).bsdf({}), down));
}

TEST_CASE("transmission is red of its texture, and only thickness makes a body solid")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(51, 255, 255, 255)};
    MaterialDesc desc;
    desc.metallic = 0.0f;
    desc.roughness = 0.5f;
    desc.transmission = 0.5f;
    desc.transmission_texture = first_image;
    const GltfParameters same{.roughness = 0.5f, .transmission = 0.1f};
    {
        const Material thin(desc, images, albedo);
        CHECK(!thin.is_solid_transmitter());
        check_equal(scattered(thin.bsdf({})), expected(same, albedo));
        CHECK(max_component(scattered(thin.bsdf({}), {0.0f, 0.0f, -1.0f})) > 0.0f);
    }
    desc.thickness = 0.1f;
    const Material solid(desc, images, albedo);
    CHECK(solid.is_solid_transmitter());
    const Vec3 in{0.3f, 0.0f, -std::sqrt(1.0f - 0.09f)};
    CHECK(scattered(solid.bsdf({}), in) != scattered(Material(
                                                         [&] {
                                                             desc.thickness = 0.0f;
                                                             return desc;
                                                         }(),
                                                         images, albedo)
                                                         .bsdf({}),
                                                     in));
    desc.thickness = 1.0f;
    desc.transmission = 0.0f;
    CHECK(!Material(desc, images, albedo).is_solid_transmitter());
}

TEST_CASE("normal maps turn the shading normal in the tangent frame")
{
    const SpecularAlbedo albedo(1.5f);
    // Nearly black, so that light which the surface has scattered before does not count.
    constexpr float dark = 1e-4f;
    MaterialDesc desc = lambert();
    desc.base_color = Vec4(Vec3(dark), 1.0f);
    desc.normal_texture = first_image;
    // x = 0.6, y = 0.2, z = 0.8 as nearly as bytes can tell
    const std::vector<TexelImage> images{texel(204, 153, 230, 255)};
    const Vec3 mapped = normalize(Vec3{0.6f, 0.2f, 2.0f * 230.0f / 255.0f - 1.0f});
    const Vec3 up{0.0f, 0.0f, 1.0f};

    const auto cosine = [&](const MaterialDesc& d, Vec4 tangent, Vec3 wi) {
        const Material material(d, images, albedo);
        CHECK(material.tangent_uv_set() == 0);
        return scattered(material.bsdf({.tangent = tangent}), wi).x * pi / dark;
    };
    // f_cos of a Lambertian is the cosine to the shading normal over pi.
    CHECK(cosine(desc, {1, 0, 0, 1}, up) == Approx(mapped.z).epsilon(1e-4));
    const Vec3 along_x = normalize(Vec3{1.0f, 0.0f, 1.0f});
    const Vec3 along_y = normalize(Vec3{0.0f, 1.0f, 1.0f});
    CHECK(cosine(desc, {1, 0, 0, 1}, along_x) == Approx(dot(mapped, along_x)).epsilon(1e-4));
    CHECK(cosine(desc, {1, 0, 0, 1}, along_y) == Approx(dot(mapped, along_y)).epsilon(1e-4));
    // The other handedness turns y over; a tangent along y turns the map by a right angle; its
    // length and its part along the normal do not count.
    CHECK(cosine(desc, {1, 0, 0, -1}, along_y) ==
          Approx(dot(Vec3{mapped.x, -mapped.y, mapped.z}, along_y)).epsilon(1e-4));
    CHECK(cosine(desc, {0, 5, 3, 1}, along_x) ==
          Approx(dot(Vec3{-mapped.y, mapped.x, mapped.z}, along_x)).epsilon(1e-4));
    // Without a tangent there is no frame for the map.
    CHECK(cosine(desc, {0, 0, 0, 0}, up) == Approx(1.0f));
    desc.normal_scale = 0.5f;
    const Vec3 flatter = normalize(Vec3{0.3f, 0.1f, 2.0f * 230.0f / 255.0f - 1.0f});
    CHECK(cosine(desc, {1, 0, 0, 1}, along_x) == Approx(dot(flatter, along_x)).epsilon(1e-4));
}

TEST_CASE("a mapped normal from below is turned up as little as possible")
{
    const SpecularAlbedo albedo(1.5f);
    constexpr float dark = 1e-4f;
    MaterialDesc desc = lambert();
    desc.base_color = Vec4(Vec3(dark), 1.0f);
    desc.normal_texture = first_image;
    const std::vector<TexelImage> images{texel(255, 128, 51, 255)};  // along +x, and below
    const ShadingPoint point{.tangent = {1.0f, 0.0f, 0.0f, 1.0f},
                             .wo = normalize(Vec3{1.0f, 0.0f, 0.5f})};
    const Bsdf bsdf = Material(desc, images, albedo).bsdf(point);
    const Vec3 wi = normalize(Vec3{1.0f, 0.0f, 0.2f});
    // (0.86, 0, -0.51) becomes (0.99995, 0, 0.01).
    const float cosine = scattered(bsdf, wi).x * pi / dark;
    CHECK(cosine == Approx(0.99995f * wi.x + 0.01f * wi.z).epsilon(1e-3));
}

TEST_CASE("emission is factor times sRGB texture, and its mean that of the image")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{{2, 1, {0, 102, 255, 255, 255, 102, 0, 255}}};
    MaterialDesc desc;
    desc.emission = {10.0f, 20.0f, 30.0f};
    CHECK(Material(desc, images, albedo).emission({}) == desc.emission);
    CHECK(Material(desc, images, albedo).mean_emission() == desc.emission);
    CHECK(!Material(desc, images, albedo).emits_from_both_sides());
    desc.emission_texture = TextureRef{.wrap_u = Wrap::clamp_to_edge};
    desc.double_sided = true;
    const Material material(desc, images, albedo);
    CHECK(material.emits_from_both_sides());
    check_equal(material.emission({.uv = {Vec2{0.25f, 0.5f}, Vec2{}}}),
                {0.0f, 20.0f * srgb(0.4), 30.0f});
    check_equal(material.mean_emission(), {5.0f, 20.0f * srgb(0.4), 15.0f});
}

TEST_CASE("absorption leaves the attenuation colour after the attenuation distance")
{
    MaterialDesc desc;
    desc.transmission = 1.0f;
    desc.thickness = 1.0f;
    CHECK(medium_within(desc).extinction == Rgb{0.0f});
    desc.attenuation_color = {0.5f, 1.0f, 0.0f};
    CHECK(medium_within(desc).extinction == Rgb{0.0f});  // at infinity
    desc.attenuation_distance = 0.25f;
    const Rgb absorption = medium_within(desc).extinction;
    CHECK(absorption.x == Approx(std::log(2.0) / 0.25));
    CHECK(absorption.y == 0.0f);
    CHECK(absorption.z > 100.0f);
    CHECK(std::isfinite(absorption.z));
    desc.attenuation_distance = 1e-38f;
    CHECK(is_finite(medium_within(desc).extinction));
    desc.thickness = 0.0f;  // a thin sheet has no inside
    CHECK(medium_within(desc).extinction == Rgb{0.0f});
}

TEST_CASE("a smooth thin sheet is clear: what it reflects decides who hits it")
{
    const SpecularAlbedo albedo(1.5f);
    const std::vector<TexelImage> images{texel(255, 255, 255, 255)};
    MaterialDesc glass;
    glass.metallic = 0.0f;
    glass.roughness = 0.0f;
    glass.transmission = 1.0f;
    glass.base_color = {0.8f, 0.7f, 0.6f, 1.0f};
    SECTION("its reflection and tint are those of the whole model")
    {
        const Material material(glass, images, albedo);
        const ClearSheet* sheet = material.clear_sheet();
        REQUIRE(sheet != nullptr);
        CHECK_FALSE(material.is_even());
        CHECK_FALSE(material.is_untinted());
        const Rgb tint = material.tint({});
        CHECK(tint == Rgb(0.8f, 0.7f, 0.6f));
        for (const float cosine : {0.05f, 0.4f, 0.8f, 1.0f}) {
            CAPTURE(cosine);
            const Vec3 wo(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
            const Bsdf whole = material.bsdf({.wo = wo});
            const auto mirrored = whole.sample(0.0f, Vec2(0.5f), TransportMode::radiance);
            const auto straight = whole.sample(0.999f, Vec2(0.5f), TransportMode::radiance);
            REQUIRE(mirrored);
            REQUIRE(straight);
            CHECK(straight->wi.z < 0.0f);
            // Densities of delta lobes are probabilities of the lobe times a cosine.
            const float reflected = mirrored->weight.x * mirrored->pdf_fwd.value / cosine;
            const Rgb passed = straight->weight * straight->pdf_fwd.value / cosine;
            for (int c = 0; c < 3; ++c) {
                CHECK(tint[c] * (1.0f - sheet->reflectance(cosine)) ==
                      Approx(passed[c]).epsilon(1e-4));
            }
            const auto hit = sheet->sample(wo, 0.5f, Vec2(0.5f), TransportMode::radiance);
            REQUIRE(hit);
            CHECK(hit->delta);
            CHECK(hit->wi == Vec3(-wo.x, -wo.y, wo.z));
            CHECK(hit->weight == Rgb(1.0f));
            CHECK(sheet->reflectance(cosine) == Approx(reflected).epsilon(1e-4));
        }
    }
    SECTION("textures and vertex colours tint it")
    {
        const std::vector<TexelImage> half{texel(255, 0, 255, 255)};
        glass.base_color_texture = first_image;
        const Material material(glass, half, albedo);
        REQUIRE(material.clear_sheet() != nullptr);
        CHECK_FALSE(material.is_untinted());
        CHECK(material.tint({}) == Rgb(0.8f, 0.0f, 0.6f));
        CHECK(material.tint({.color = {0.5f, 0.5f, 9.0f, 0.1f}}) == Rgb(0.4f, 0.0f, 1.0f));
        glass.base_color = Vec4(1.0f);
        glass.base_color_texture.reset();
        CHECK(Material(glass, images, albedo).is_untinted());
    }
    SECTION("a specular colour that is grey counts")
    {
        glass.specular_color = Rgb(0.5f);
        glass.specular = 0.9f;
        const Material material(glass, images, albedo);
        REQUIRE(material.clear_sheet() != nullptr);
        CHECK(material.clear_sheet()->reflectance(1.0f) == Approx(0.04f * 0.5f * 0.9f));
    }
    SECTION("others are not")
    {
        const auto is_clear = [&](const auto& change) {
            MaterialDesc other = glass;
            change(other);
            return Material(other, images, albedo).clear_sheet() != nullptr;
        };
        CHECK(is_clear([](MaterialDesc&) {}));
        CHECK(is_clear([](MaterialDesc& m) { m.base_color_texture = first_image; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.specular_color.z = 0.7f; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.transmission = 0.9f; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.metallic = 0.1f; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.roughness = 0.1f; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.emission = Rgb(1.0f); }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.unlit = true; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.alpha_mode = AlphaMode::blend; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.transmission_texture = first_image; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.metallic_roughness_texture = first_image; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.specular_texture = first_image; }));
        CHECK_FALSE(is_clear([](MaterialDesc& m) { m.normal_texture = first_image; }));
    }
}

}  // namespace bdpt::test::material_test
