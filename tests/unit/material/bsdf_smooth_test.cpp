#include "bsdf_cases.h"
#include "catch.hpp"
#include "math/rgb.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>

namespace bdpt::test::bsdf_smooth_test {
namespace {

const float ior = 1.5f;

/// A perfectly smooth transmitter; white, so that F and 1 - F are its weights.
GltfParameters smooth_glass(Body body)
{
    return {.base_color = Rgb{1.0f}, .roughness = 0.0f, .transmission = 1.0f, .body = body};
}

/// Fresnel's equations in the textbook's form, in double.
double fresnel(double cos_i, double n_i, double n_t)
{
    const double sin_t = n_i / n_t * std::sqrt(1.0 - cos_i * cos_i);
    if (sin_t >= 1.0) {
        return 1.0;
    }
    const double cos_t = std::sqrt(1.0 - sin_t * sin_t);
    const double s = (n_i * cos_i - n_t * cos_t) / (n_i * cos_i + n_t * cos_t);
    const double p = (n_t * cos_i - n_i * cos_t) / (n_t * cos_i + n_i * cos_t);
    return 0.5 * (s * s + p * p);
}

}  // namespace

TEST_CASE("smooth glass reflects and refracts by Fresnel and Snell")
{
    const SpecularAlbedo albedo(ior);
    const MetallicRoughness bsdf(smooth_glass(Body::solid), albedo);
    CHECK(!bsdf.has_smooth_lobe());
    for (const Vec3 wo : test::bsdf_directions()) {
        const double n_o = wo.z > 0.0f ? 1.0 : 1.5;
        const double n_i = wo.z > 0.0f ? 1.5 : 1.0;
        const double cos_o = std::abs(static_cast<double>(wo.z));
        const double f = fresnel(cos_o, n_o, n_i);
        CAPTURE(wo.x, wo.y, wo.z, f);

        const auto mirror =
            bsdf.sample(wo, static_cast<float>(0.5 * f), {}, TransportMode::radiance);
        REQUIRE(mirror);
        CHECK(mirror->delta);
        CHECK(mirror->wi == Vec3{-wo.x, -wo.y, wo.z});
        CHECK(mirror->weight.x == Approx(1.0).epsilon(1e-4));  // F / P, and P is F here
        CHECK(mirror->pdf_fwd.value == Approx(f * cos_o * n_o * n_o).epsilon(1e-4));
        CHECK(mirror->pdf_rev.value == Approx(mirror->pdf_fwd.value));

        const float u_through = std::min(0.999f, static_cast<float>(0.5 + 0.5 * f));
        const auto through = bsdf.sample(wo, u_through, {}, TransportMode::radiance);
        const auto importance = bsdf.sample(wo, u_through, {}, TransportMode::importance);
        REQUIRE(through);
        REQUIRE(importance);
        if (f == 1.0) {
            CHECK(through->wi == mirror->wi);
            continue;
        }
        CHECK(through->wi.z * wo.z < 0.0f);
        // n_o sin_o = n_i sin_i, in the plane of incidence
        CHECK(through->wi.x * 1.0 == Approx(-static_cast<double>(wo.x) * n_o / n_i).margin(1e-6));
        CHECK(through->wi.y * 1.0 == Approx(-static_cast<double>(wo.y) * n_o / n_i).margin(1e-6));
        const double cos_i = std::abs(static_cast<double>(through->wi.z));
        CHECK(through->weight.x == Approx(n_o * n_o / (n_i * n_i)).epsilon(1e-4));
        CHECK(importance->weight.x == Approx(1.0).epsilon(1e-4));
        CHECK(through->pdf_fwd.value == Approx((1.0 - f) * cos_i * n_i * n_i).epsilon(1e-4));
        CHECK(through->pdf_rev.value == Approx((1.0 - f) * cos_o * n_o * n_o).epsilon(1e-4));
        CHECK(importance->pdf_fwd.value == through->pdf_fwd.value);
    }
}

TEST_CASE("smooth lobes know the density of the way back")
{
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const SpecularAlbedo albedo(bsdf_case.ior);
        const MetallicRoughness bsdf(bsdf_case.surface, albedo);
        test::Random random(59);
        int found = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 wo = random.direction();
            const auto there = bsdf.sample(wo, random.next(), {}, TransportMode::radiance);
            if (!there || !there->delta || std::abs(there->wi.z) < 0.01f) {
                continue;
            }
            // The same choice from the other end leads back, for some number.
            for (int k = 0; k < 64; ++k) {
                const float u_lobe = (static_cast<float>(k) + 0.5f) / 64.0f;
                const auto back = bsdf.sample(there->wi, u_lobe, {}, TransportMode::radiance);
                if (!back || !back->delta || dot(back->wi, wo) < 0.99999f ||
                    back->wi.z * wo.z < 0.0f) {
                    continue;
                }
                CAPTURE(bsdf_case.name, wo.z, there->wi.z);
                CHECK(back->pdf_fwd.value == Approx(there->pdf_rev.value).epsilon(1e-3));
                CHECK(back->pdf_rev.value == Approx(there->pdf_fwd.value).epsilon(1e-3));
                ++found;
                break;
            }
        }
        CAPTURE(bsdf_case.name);
        const bool smooth =
            bsdf_case.surface.roughness == 0.0f || bsdf_case.name == "solid 0.5 ior 1";
        CHECK((found > 50) == smooth);
    }
}

TEST_CASE("thin glass lets light straight through")
{
    const SpecularAlbedo albedo(ior);
    const MetallicRoughness bsdf(smooth_glass(Body::thin_walled), albedo);
    for (const Vec3 wo : test::bsdf_directions()) {
        const double cos_o = std::abs(static_cast<double>(wo.z));
        const double f = fresnel(cos_o, 1.0, 1.5);
        const auto through =
            bsdf.sample(wo, static_cast<float>(0.5 + 0.5 * f), {}, TransportMode::radiance);
        REQUIRE(through);
        CHECK(through->delta);
        CHECK(through->wi == -wo);
        CHECK(through->weight.x == Approx(1.0).epsilon(1e-4));
        CHECK(through->pdf_fwd.value == Approx((1.0 - f) * cos_o).epsilon(1e-3));
        CHECK(through->pdf_rev.value == Approx((1.0 - f) * cos_o).epsilon(1e-3));
    }
}

TEST_CASE("a smooth coat over a base is both delta and connectible")
{
    const SpecularAlbedo albedo(ior);
    const MetallicRoughness bsdf({.base_color = Rgb{0.5f}, .roughness = 0.0f}, albedo);
    CHECK(bsdf.has_smooth_lobe());
    const Vec3 wo = normalize(Vec3{1.0f, 0.0f, 1.0f});
    const auto mirror = bsdf.sample(wo, 0.0f, {}, TransportMode::radiance);
    REQUIRE(mirror);
    REQUIRE(mirror->delta);
    const auto base = bsdf.sample(wo, 0.999f, {0.3f, 0.6f}, TransportMode::radiance);
    REQUIRE(base);
    CHECK(!base->delta);
    // One choice or the other: what the mirror does not take, the base has.
    const double f = fresnel(static_cast<double>(wo.z), 1.0, 1.5);
    const float choice = mirror->pdf_fwd.value / wo.z;
    CHECK(mirror->weight.x * choice == Approx(f).epsilon(1e-4));
    CHECK(base->pdf_fwd.value == Approx((1.0f - choice) * inv_pi * base->wi.z).epsilon(1e-5));
    // The mirror itself is not part of eval.
    const BsdfEval value = bsdf.eval(wo, mirror->wi, TransportMode::radiance);
    CHECK(value.pdf_fwd.value == Approx((1.0f - choice) * inv_pi * wo.z).epsilon(1e-4));
}

TEST_CASE("base colour tints once per crossing and reflection not at all")
{
    const SpecularAlbedo albedo(ior);
    const Rgb tint{0.2f, 0.5f, 0.8f};
    for (const Body body : {Body::thin_walled, Body::solid}) {
        GltfParameters surface = smooth_glass(body);
        surface.base_color = tint;
        const MetallicRoughness bsdf(surface, albedo);
        const Vec3 wo{0.0f, 0.0f, 1.0f};
        const auto mirror = bsdf.sample(wo, 0.0f, {}, TransportMode::importance);
        const auto through = bsdf.sample(wo, 0.9f, {}, TransportMode::importance);
        REQUIRE((mirror && through));
        const float reflect_choice = mirror->pdf_fwd.value;
        CHECK(mirror->weight.x * reflect_choice == Approx(0.04f).epsilon(1e-4));
        CHECK(mirror->weight.z == mirror->weight.x);
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(through->weight[channel] * (1.0f - reflect_choice) ==
                  Approx(0.96f * tint[channel]).epsilon(1e-4));
        }
    }
}

TEST_CASE("total reflection keeps its energy where specular is low")
{
    const SpecularAlbedo albedo(ior);
    GltfParameters surface = smooth_glass(Body::solid);
    surface.specular = 0.25f;
    const MetallicRoughness bsdf(surface, albedo);
    const Vec3 wo = normalize(Vec3{1.0f, 0.5f, -0.5f});
    const auto sampled = bsdf.sample(wo, 0.9f, {}, TransportMode::radiance);
    REQUIRE(sampled);
    CHECK(sampled->wi.z == wo.z);
    CHECK(sampled->weight == Rgb{1.0f});
}

TEST_CASE("metal in a solid body reflects by the angle that it is seen at, from both sides")
{
    const SpecularAlbedo albedo(ior);
    const Rgb gold{1.0f, 0.7f, 0.3f};
    const MetallicRoughness metal({gold, 1, 0, 1, Rgb{1.0f}, 1, Body::solid}, albedo);
    // From within, 0.5 is beyond the critical angle of glass, where metal reflects no more than
    // elsewhere.
    for (const float z : {0.9f, 0.5f, 0.1f, -0.9f, -0.5f, -0.1f}) {
        const Vec3 wo{std::sqrt(1.0f - z * z), 0.0f, z};
        const auto mirror = metal.sample(wo, 0.5f, {}, TransportMode::radiance);
        REQUIRE(mirror);
        CAPTURE(z);
        for (int channel = 0; channel < 3; ++channel) {
            const float schlick =
                gold[channel] + (1.0f - gold[channel]) * std::pow(1.0f - std::abs(z), 5.0f);
            CHECK(mirror->weight[channel] == Approx(schlick).epsilon(1e-5));
        }
    }
}

}  // namespace bdpt::test::bsdf_smooth_test
