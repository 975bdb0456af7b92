#include "bsdf_cases.h"
#include "catch.hpp"
#include "math/rgb.h"

#include <cmath>
#include <vector>

namespace bdpt::test::bsdf_robustness_test {
namespace {

/// Directions where divisions and roots are at their worst.
std::vector<Vec3> extreme_directions()
{
    std::vector<Vec3> directions = test::bsdf_directions();
    directions.push_back({0.0f, 0.0f, 1.0f});
    directions.push_back({0.0f, 0.0f, -1.0f});
    directions.push_back({1.0f, 0.0f, 0.0f});
    for (const float z : {1e-3f, 1e-6f, 1e-12f, 1e-30f, 1e-44f}) {
        directions.push_back({std::sqrt(1.0f - z * z), 0.0f, z});
        directions.push_back({0.0f, -std::sqrt(1.0f - z * z), -z});
    }
    return directions;
}

constexpr float last = 1.0f - 0x1p-24f;  // the largest random number

bool sound(Rgb value)
{
    return is_finite(value) && value.r >= 0.0f && value.g >= 0.0f && value.b >= 0.0f;
}

bool sound(SolidAnglePdf pdf)
{
    return std::isfinite(pdf.value) && pdf.value >= 0.0f;
}

}  // namespace

TEST_CASE("BSDFs stay finite in the corners of their domain", "[long]")
{
    std::vector<test::BsdfCase> cases = test::bsdf_cases();
    const Rgb white{1.0f};
    cases.push_back(
        {"mirror-like dielectric", {white, 0, 0.4f, 1, white, 0.5f, Body::solid}, 1e6f});
    cases.push_back({"barely rough", {white, 0, 0.0317f, 1, white, 0.5f, Body::solid}, 1.0011f});
    cases.push_back({"bright specular", {white, 0, 0, 1, Rgb{100.0f}, 0, Body::thin_walled}, 2.0f});
    cases.push_back({"grooves in a mirror", {white, 1, 0}, 1.5f, test::brushed(0.5f)});
    const std::vector<Vec3> directions = extreme_directions();
    const std::vector<float> numbers{0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, last};
    for (const test::BsdfCase& bsdf_case : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : directions) {
            for (const Vec3 wi : directions) {
                CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
                const BsdfEval value = bsdf.eval(wo, wi, TransportMode::radiance);
                REQUIRE(sound(value.f_cos));
                REQUIRE(sound(value.pdf_fwd));
                REQUIRE(sound(value.pdf_rev));
            }
            for (const float u_lobe : numbers) {
                for (const float u : numbers) {
                    for (const float v : numbers) {
                        CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, u_lobe, u, v);
                        const auto sampled =
                            bsdf.sample(wo, u_lobe, {u, v}, TransportMode::radiance);
                        if (!sampled) {
                            continue;
                        }
                        REQUIRE(sound(sampled->weight));
                        REQUIRE(sound(sampled->pdf_fwd));
                        REQUIRE(sound(sampled->pdf_rev));
                        REQUIRE(sampled->pdf_fwd.value > 0.0f);
                        REQUIRE(sampled->wi.z != 0.0f);
                        REQUIRE(dot(sampled->wi, sampled->wi) == Approx(1.0f).epsilon(1e-4));
                    }
                }
            }
        }
    }
}

TEST_CASE("parameters out of range are clamped")
{
    const SpecularAlbedo albedo(1.5f);
    const MetallicRoughness wild({Rgb{-1.0f, 0.5f, 7.0f}, 3.0f, -0.5f, 9.0f, Rgb{-2.0f}, 5.0f},
                                 albedo);
    const MetallicRoughness tame({Rgb{0.0f, 0.5f, 1.0f}, 1.0f, 0.0f, 1.0f, Rgb{0.0f}, 1.0f},
                                 albedo);
    const Vec3 wo = normalize(Vec3{0.2f, 0.4f, 0.9f});
    const auto a = wild.sample(wo, 0.3f, {}, TransportMode::radiance);
    const auto b = tame.sample(wo, 0.3f, {}, TransportMode::radiance);
    REQUIRE((a && b));
    CHECK(a->weight == b->weight);
    CHECK(a->pdf_fwd.value == b->pdf_fwd.value);
}

}  // namespace bdpt::test::bsdf_robustness_test
