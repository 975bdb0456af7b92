#include "bsdf_cases.h"
#include "catch.hpp"
#include "material/lobes/interreflection.h"
#include "material/lobes/rough_diffuse.h"
#include "math/rgb.h"
#include "math/warp.h"
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

TEST_CASE("no BSDF makes energy", "[long]")
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

TEST_CASE("a white surface without loss is invisible in a white furnace", "[long]")
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

TEST_CASE("a rough diffuse white surface is invisible in a white furnace, below any boundary",
          "[long]")
{
    const Rgb white{1.0f};
    for (const float diffuse_roughness : {0.3f, 1.0f}) {
        const LayeredParameters layers = test::rough_diffuse(diffuse_roughness);
        const std::vector<test::BsdfCase> cases{
            {"without a boundary", {white, 0, 1, 0}, 1.5f, layers},
            {"smooth", {white, 0, 0}, 1.5f, layers},
            {"smooth, index 1.2", {white, 0, 0}, 1.2f, layers},
            {"0.3", {white, 0, 0.3f}, 1.5f, layers},
            {"0.7, half specular", {white, 0, 0.7f, 0.5f}, 1.5f, layers},
            {"1, index 2.4", {white, 0, 1}, 2.4f, layers},
        };
        for (const test::BsdfCase& bsdf_case : cases) {
            const test::TestedBsdf bsdf(bsdf_case);
            for (const Vec3 wo : test::bsdf_directions()) {
                CAPTURE(bsdf_case.name, diffuse_roughness, wo.z);
                const test::Moments sum = albedo_of(bsdf, wo, 100000)[0];
                CHECK(sum.standard_error() < 0.0015);
                CHECK(sum.mean() < 1.001 + 4.0 * sum.standard_error());
                CHECK(sum.mean() > 0.995 - 4.0 * sum.standard_error());
            }
        }
    }
}

TEST_CASE("the mean albedo of a rough diffuse surface is its colour", "[diffuse]")
{
    const Rgb color{0.2f, 0.5f, 0.9f};
    for (const float roughness : {0.1f, 0.5f, 1.0f}) {
        const RoughDiffuseReflection lobe(color, RoughDiffuse(roughness));
        test::Random random(7);
        std::array<test::Moments, 3> sums;
        for (int i = 0; i < 40000; ++i) {
            const Vec3 wo = square_to_cosine_hemisphere(random.next_2d());
            const float u_lobe = random.next();
            const auto sampled =
                lobe.sample(wo, u_lobe, random.next_2d(), TransportMode::importance);
            const BsdfEval value = lobe.eval(wo, sampled->wi, TransportMode::importance);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                sums[channel].add(static_cast<double>(value.f_cos[static_cast<int>(channel)] /
                                                      value.pdf_fwd.value));
            }
        }
        for (std::size_t channel = 0; channel < 3; ++channel) {
            CAPTURE(roughness, channel);
            CHECK(sums[channel].mean() ==
                  Approx(static_cast<double>(color[static_cast<int>(channel)])).epsilon(0.005));
            // Cosine-weighted directions vary by half of the value.
            CHECK(sums[channel].standard_error() < 0.0015);
        }
        // It reflects more light back to where it came from.
        const Vec3 low = normalize(Vec3(1.0f, 0.0f, 0.5f));
        const auto brightness = [&](Vec3 wi) {
            return lobe.eval(low, wi, TransportMode::importance).f_cos.g / wi.z;
        };
        CHECK(brightness(low) > (1.0f + 0.5f * roughness) * brightness({-low.x, 0.0f, low.z}));
    }
}

TEST_CASE("rough white metal and clear glass are invisible in a white furnace, too", "[long]")
{
    constexpr Body solid = Body::solid;
    const Rgb white{1.0f};
    const Rgb black{0.0f};
    const std::vector<test::BsdfCase> cases{
        // Dielectrics that reflect all light leave none for their base.
        {"infinite index 0.3", {black, 0, 0.3f}, 1e6f},
        {"infinite index 1", {black, 0, 1}, 1e6f},
        {"infinite index 0.6 above grey", {Rgb{0.5f}, 0, 0.6f}, 1e6f},
        {"like metal 0.8", {black, 0, 0.8f, 1, Rgb{25}}},
        {"like metal 0.8 above white", {white, 0, 0.8f, 1, Rgb{25}}},
        {"index 3 0.7", {white, 0, 0.7f}, 3.0f},
        {"index 1000 1", {white, 0, 1}, 1000.0f},
        {"metal 0.1", {white, 1, 0.1f}},
        {"metal 0.3", {white, 1, 0.3f}},
        {"metal 0.5", {white, 1, 0.5f}},
        {"metal 0.8", {white, 1, 0.8f}},
        {"metal 1", {white, 1, 1}},
        {"half metal 0.6", {white, 0.5f, 0.6f}},
        {"glass 0.1", {white, 0, 0.1f, 1, white, 1, solid}},
        {"glass 0.3", {white, 0, 0.3f, 1, white, 1, solid}},
        {"glass 0.5 ior 2.4", {white, 0, 0.5f, 1, white, 1, solid}, 2.4f},
        {"glass 0.6 ior 1.33", {white, 0, 0.6f, 1, white, 1, solid}, 1.33f},
        {"glass 0.8", {white, 0, 0.8f, 1, white, 1, solid}},
        {"glass 1", {white, 0, 1, 1, white, 1, solid}},
        {"glass 0.7 half specular", {white, 0, 0.7f, 0.5f, white, 1, solid}},
        {"thin glass 0.4", {white, 0, 0.4f, 1, white, 1}},
        {"thin glass 1", {white, 0, 1, 1, white, 1}},
        {"thin half transmission 0.7", {white, 0, 0.7f, 1, white, 0.5f}},
        // From within glass, too.
        {"metal 0.8 in glass", {white, 1, 0.8f, 1, white, 1, solid}},
        {"half metal half glass 0.6", {white, 0.5f, 0.6f, 1, white, 1, solid}},
    };
    for (const test::BsdfCase& bsdf_case : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : test::bsdf_directions()) {
            CAPTURE(bsdf_case.name, wo.z);
            const test::Moments sum = albedo_of(bsdf, wo, 200000)[0];
            CHECK(sum.standard_error() < 0.0015);
            // Tables of roughness and cosine are good to 0.2 %.
            CHECK(std::abs(sum.mean() - 1.0) < 0.002 + 3.0 * sum.standard_error());
        }
    }
}

TEST_CASE("a dielectric with the reflectance of gold above black is as bright as gold")
{
    const Rgb gold{1.0f, 0.77f, 0.34f};
    const SpecularAlbedo index(1.5f);
    const Rgb specular = gold / index.normal_reflectance();
    const float roughness = GENERATE(0.2f, 0.5f, 0.8f, 1.0f);
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const auto metal = albedo_of(test::TestedBsdf({"metal", {gold, 1, roughness}}), up, 40000);
    const auto like = albedo_of(
        test::TestedBsdf({"like gold", {Rgb{0.0f}, 0, roughness, 1, specular}}), up, 40000);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        CAPTURE(roughness, channel);
        // Schlick's approximation for metal differs a little from Fresnel's equations.
        CHECK(like[channel].mean() == Approx(metal[channel].mean()).epsilon(0.012));
    }
}

TEST_CASE("plastic keeps all light for its base that its microfacets do not reflect at once")
{
    // Seen straight at the same index, light leaves black plastic by single scattering alone.
    const float roughness = GENERATE(0.3f, 1.0f);
    const SpecularAlbedo index(1.5f);
    const auto split = index.directional(1.0f, SpecularAlbedo::at_roughness(roughness));
    const auto plastic = albedo_of(test::TestedBsdf({"plastic", {Rgb{0.0f}, 0, roughness}}),
                                   {0.0f, 0.0f, 1.0f}, 40000);
    const float once = index.normal_reflectance() * split.f0 + split.f90;
    CHECK(plastic[0].mean() == Approx(once).epsilon(0.01));
}

TEST_CASE("layers take from what lies below no more than they give, and not much")
{
    const Rgb white{1.0f};
    // Of light that a sheen reflects into other directions than it came from, less is left below:
    // at most the difference of the shares of both. Mirrors below a layer lose nothing at all.
    const std::vector<std::pair<test::BsdfCase, double>> cases{
        {{"smooth coat on a mirror", {white, 1, 0}, 1.5f, test::coated(1, 0)}, 0.001},
        {{"half a coat on a mirror", {white, 1, 0}, 1.5f, test::coated(0.5f, 0)}, 0.001},
        {{"sheen on a mirror", {white, 1, 0}, 1.5f, test::sheen(white, 0.5f)}, 0.01},
        {{"sheen 0.5 on lambert", {white, 0, 1, 0}, 1.5f, test::sheen(white, 0.5f)}, 0.25},
    };
    for (const auto& [bsdf_case, max_lost] : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : test::bsdf_directions()) {
            CAPTURE(bsdf_case.name, wo.z);
            const test::Moments sum = albedo_of(bsdf, wo, 40000)[0];
            CHECK(sum.standard_error() < 0.01);
            CHECK(sum.mean() < 1.001 + 4.0 * sum.standard_error());
            CHECK(sum.mean() > 1.0 - max_lost - 4.0 * sum.standard_error());
        }
    }
}

TEST_CASE("rough metal reflects once what it must, and the rest after more reflections")
{
    const Vec3 up{0.0f, 0.0f, 1.0f};
    // Seen straight, alpha = 1: D = 1 / pi and the integral of z / (1 + z) is 1 - log 2.
    const double once = 1.0 - std::log(2.0);
    const test::TestedBsdf white({"metal", {Rgb{1.0f}, 1, 1}});
    // Upwards alone, in the direction where single scattering is known: f cos = 1 / (4 pi).
    const Vec3 wi{0.0f, 0.0f, 1.0f};
    const float f_cos = white.eval(up, wi, TransportMode::importance).f_cos.r;
    const float interreflected = f_cos - 0.25f * inv_pi;
    CHECK(interreflected > 0.0f);
    // Its lobe is cosine-distributed but for what is missing at wi, 0.69 there.
    const test::Moments all = albedo_of(white, up, 100000)[0];
    CHECK(std::abs(all.mean() - 1.0) < 0.002 + 4.0 * all.standard_error());
    // Darker metal reflects less of what is reflected often: a black one has single scattering
    // by Schlick's rest alone, and a grey one less than half of a white one.
    const test::Moments grey =
        albedo_of(test::TestedBsdf({"metal", {Rgb{0.5f}, 1, 1}}), up, 100000)[0];
    CHECK(grey.mean() < 0.5);
    CHECK(grey.mean() > 0.5 * once);
}

TEST_CASE("interreflection is the sum of all reflections after the first")
{
    // Of what comes back, `average` leaves and the rest is reflected again.
    const float average = GENERATE(0.3f, 0.9f);
    const Rgb f0{0.0f, 0.5f, 1.0f};
    const Interreflection lobe(f0, average, 1.0f);
    for (int channel = 0; channel < 3; ++channel) {
        const double r = static_cast<double>(f0[channel] + (1.0f - f0[channel]) / 21.0f);
        double sum = 0.0;
        double left = r;  // reflected once, and masked
        for (int k = 0; k < 400; ++k) {
            sum += left * r * static_cast<double>(average);
            left *= r * static_cast<double>(1.0f - average);
        }
        const Rgb f_cos =
            lobe.lobe(1.0f, 1.0f)
                .eval({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, TransportMode::importance)
                .f_cos;
        const double scale = static_cast<double>(1.0f - average) / static_cast<double>(inv_pi);
        CHECK(static_cast<double>(f_cos[channel]) * scale == Approx(sum).epsilon(1e-4));
    }
    CHECK(lobe.weight() == Approx(1.0f));
}

}  // namespace bdpt::test::bsdf_energy_test
