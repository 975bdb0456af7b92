#include "bsdf_cases.h"
#include "catch.hpp"
#include "math/rgb.h"
#include "statistics.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace bdpt::test::bsdf_energy_test {
namespace {

/// The share of light from `wo` that is scattered at all: the mean weight of importance samples.
std::array<test::Moments, 3> albedo_of(const test::TestedBsdf& bsdf, Vec3 wo, int samples)
{
    std::array<test::Moments, 3> moments;
    test::Random random(53);
    for (int i = 0; i < samples; ++i) {
        const float u_lobe = random.next();
        const auto sampled = bsdf.sample(wo, u_lobe, random.next_2d(), TransportMode::importance);
        for (int channel = 0; channel < 3; ++channel) {
            moments[static_cast<std::size_t>(channel)].add(
                sampled ? static_cast<double>(sampled->weight[channel]) : 0.0);
        }
    }
    return moments;
}

}  // namespace

TEST_CASE("no BSDF makes energy")
{
    for (test::BsdfCase bsdf_case : test::bsdf_cases()) {
        bsdf_case.surface.base_color = Rgb{1.0f};
        if (bsdf_case.layers) {
            bsdf_case.layers->transmission_color = Color16(Rgb{1.0f});
        }
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : test::bsdf_directions()) {
            CAPTURE(bsdf_case.name, wo.z);
            for (const test::Moments& channel : albedo_of(bsdf, wo, 40000)) {
                CHECK(channel.standard_error() < 0.006);
                CHECK(channel.mean() < 1.001 + 4.0 * channel.standard_error());
            }
        }
    }
}

TEST_CASE("a white surface without loss is invisible in a white furnace")
{
    // Roughness that does not lose light between facets, or whose loss the base makes good.
    constexpr Body solid = Body::solid;
    const Rgb white{1.0f};
    const std::vector<test::BsdfCase> cases{
        {"lambert", {white, 0, 0.5f, 0}},
        {"smooth dielectric", {white, 0, 0}},
        {"dielectric 0.033", {white, 0, 0.033f}},
        {"dielectric 0.1", {white, 0, 0.1f}},
        {"dielectric 0.3", {white, 0, 0.3f}},
        {"dielectric 0.7 half specular", {white, 0, 0.7f, 0.5f}},
        {"dielectric 1 ior 2.4", {white, 0, 1}, 2.4f},
        {"dielectric ior 1", {white, 0, 0.3f}, 1.0f},
        {"smooth metal", {white, 1, 0}},
        {"smooth glass", {white, 0, 0, 1, white, 1, solid}},
        {"smooth glass 2.4", {white, 0, 0, 1, white, 1, solid}, 2.4f},
        {"smooth glass without specular", {white, 0, 0, 0, white, 1, solid}},
        {"smooth thin glass", {white, 0, 0, 1, white, 1}},
        {"smooth half glass half metal", {white, 0.5f, 0, 1, white, 1, solid}},
        {"smooth thin glass over base", {white, 0, 0, 1, white, 0.5f}},
        {"rough glass of equal index", {white, 0, 0.5f, 1, white, 1, solid}, 1.0f},
    };
    for (const test::BsdfCase& bsdf_case : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : test::bsdf_directions()) {
            CAPTURE(bsdf_case.name, wo.z);
            const test::Moments sum = albedo_of(bsdf, wo, 100000)[0];
            CHECK(sum.standard_error() < 0.0015);
            CHECK(std::abs(sum.mean() - 1.0) < 0.001 + 4.0 * sum.standard_error());
        }
    }
}

TEST_CASE("layers take from what lies below no more than they give, and not much")
{
    const Rgb white{1.0f};
    // Of light that a layer reflects into other directions than it came from, less is left below:
    // at most the difference of the shares of both. Mirrors below a layer lose nothing at all.
    const std::vector<std::pair<test::BsdfCase, double>> cases{
        {{"smooth coat on a mirror", {white, 1, 0}, 1.5f, test::coated(1, 0)}, 0.001},
        {{"half a coat on a mirror", {white, 1, 0}, 1.5f, test::coated(0.5f, 0)}, 0.001},
        {{"sheen on a mirror", {white, 1, 0}, 1.5f, test::sheen(white, 0.5f)}, 0.01},
        {{"smooth coat on lambert", {white, 0, 1, 0}, 1.5f, test::coated(1, 0)}, 0.08},
        {{"coat 0.3 on lambert", {white, 0, 1, 0}, 1.5f, test::coated(1, 0.3f)}, 0.08},
        {{"sheen 0.5 on lambert", {white, 0, 1, 0}, 1.5f, test::sheen(white, 0.5f)}, 0.25},
    };
    for (const auto& [bsdf_case, most_lost] : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : test::bsdf_directions()) {
            CAPTURE(bsdf_case.name, wo.z);
            const test::Moments sum = albedo_of(bsdf, wo, 40000)[0];
            CHECK(sum.standard_error() < 0.01);
            CHECK(sum.mean() < 1.001 + 4.0 * sum.standard_error());
            CHECK(sum.mean() > 1.0 - most_lost - 4.0 * sum.standard_error());
        }
    }
}

TEST_CASE("rough metal loses what single scattering must lose")
{
    const Vec3 up{0.0f, 0.0f, 1.0f};
    // Seen straight, alpha = 1: D = 1 / pi and the integral of z / (1 + z) is 1 - log 2.
    const auto white_metal = [](float roughness) {
        return test::TestedBsdf({"metal", {Rgb{1.0f}, 1, roughness}});
    };
    const test::Moments rough = albedo_of(white_metal(1.0f), up, 100000)[0];
    CHECK(rough.standard_error() < 0.002);
    CHECK(std::abs(rough.mean() - (1.0 - std::log(2.0))) < 4.0 * rough.standard_error());
    // Nearly smooth metal loses nearly nothing.
    CHECK(albedo_of(white_metal(0.2f), up, 100000)[0].mean() > 0.995);
}

}  // namespace bdpt::test::bsdf_energy_test
