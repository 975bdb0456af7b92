
#include "catch.hpp"
#include "chi_square.h"
#include "material/medium.h"
#include "math/sampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::test::henyey_greenstein_test {
namespace {

/// Probability that the cosine to the way of the light is below `c`.
double below(double c, double g)
{
    if (g == 0.0) {
        return 0.5 * (1.0 + c);
    }
    return (1.0 - g * g) / (2.0 * g) *
           (1.0 / std::sqrt(1.0 + g * g - 2.0 * g * c) - 1.0 / (1.0 + g));
}

constexpr int cosines = 30;
constexpr int sectors = 6;

std::vector<double> probabilities(double g)
{
    std::vector<double> result;
    for (int i = 0; i < cosines; ++i) {
        const double share =
            below(2.0 * (i + 1.0) / cosines - 1.0, g) - below(2.0 * i / cosines - 1.0, g);
        result.insert(result.end(), sectors, share / sectors);
    }
    return result;
}

}  // namespace

TEST_CASE("phase functions sample what they say, and scatter all of it", "[media]")
{
    const double significance = test::sidak(0.01, 6);
    const Rgb scattering(0.5f, 2.0f, 7.0f);
    const Vec3 wo(0.0f, 0.0f, 1.0f);
    for (const float g : {-0.9f, -0.3f, 0.0f, 0.0015f, 0.5f, 0.95f}) {
        CAPTURE(g);
        const HenyeyGreenstein phase(scattering, g);
        std::vector<double> counts(std::size_t{cosines} * sectors);
        double along = 0.0;
        constexpr int samples = 60000;
        for (int i = 0; i < samples; ++i) {
            Sampler sampler(SamplerKind::independent, 5, i, 0, 0);
            const auto sampled = phase.sample(wo, 0.0f, sampler.next_2d(), TransportMode::radiance);
            REQUIRE(sampled.has_value());
            REQUIRE(sampled->weight == scattering);
            const BsdfEval value = phase.eval(wo, sampled->wi, TransportMode::radiance);
            REQUIRE(value.pdf_fwd.value == value.pdf_rev.value);
            REQUIRE(value.f_cos == scattering * value.pdf_fwd.value);
            REQUIRE(sampled->pdf_fwd.value == Approx(value.pdf_fwd.value).epsilon(1e-3));
            // Its density is the derivative of what lies below.
            const double c = static_cast<double>(-sampled->wi.z);
            const auto [x, y] = std::pair(sampled->wi.x, sampled->wi.y);
            const double turn = std::atan2(static_cast<double>(y), static_cast<double>(x));
            const int ring = std::min(static_cast<int>(0.5 * (c + 1.0) * cosines), cosines - 1);
            const int sector =
                std::min(static_cast<int>((turn / 6.2831853072 + 0.5) * sectors), sectors - 1);
            counts[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
            along += c / samples;
        }
        const test::ChiSquare chi_square =
            test::chi_square(counts, probabilities(static_cast<double>(g)));
        CHECK(chi_square.p_value > significance);
        CHECK(chi_square.degrees >= 10);
        // The mean cosine is g, and g > 0 goes on the way that the light went.
        CHECK(along == Approx(static_cast<double>(g)).margin(0.01));
        for (const double c : {-0.99, -0.5, 0.0, 0.3, 0.97}) {
            const Vec3 wi(std::sqrt(1.0 - c * c), 0.0, -c);
            const double density = (below(c + 1e-4, static_cast<double>(g)) -
                                    below(c - 1e-4, static_cast<double>(g))) /
                                   (2e-4 * 6.2831853072);
            CHECK(phase.eval(wo, wi, TransportMode::importance).pdf_fwd.value ==
                  Approx(density).epsilon(1e-3));
        }
    }
}

TEST_CASE("the sharpest phase functions have the density that they sample with", "[media]")
{
    // Nearly all light stays within a hundredth of a degree.
    const Vec3 wo(0.0f, 0.0f, 1.0f);
    for (const float g : {-max_anisotropy, 0.999f, max_anisotropy}) {
        const HenyeyGreenstein phase(Rgb(1.0f), g);
        double inverse = 0.0;  // the mean of 1 / density is the solid angle of all directions
        constexpr int count = 100000;
        for (int i = 0; i < count; ++i) {
            const Vec2 u((static_cast<float>(i) + 0.5f) / count, 0.3f);
            const auto sampled = phase.sample(wo, 0.0f, u, TransportMode::radiance);
            REQUIRE(sampled.has_value());
            const float density =
                phase.eval(wo, sampled->wi, TransportMode::radiance).pdf_fwd.value;
            CAPTURE(g, u.x);
            REQUIRE(density == Approx(sampled->pdf_fwd.value).epsilon(1e-3));
            inverse += 1.0 / static_cast<double>(density) / count;
        }
        CHECK(inverse == Approx(12.566370614).epsilon(0.02));
    }
}

TEST_CASE("bodies scatter by the multi-scatter colour of the draft", "[media]")
{
    MaterialDesc wax;
    wax.thickness = 1.0f;
    wax.diffuse_transmission.factor = 1.0f;
    wax.attenuation_color = Rgb(std::exp(-1.0f));
    wax.attenuation_distance = 0.5f;
    wax.volume_scatter = {.color = {0.0f, 0.5f, 1.0f}, .anisotropy = -0.2f};
    const Medium medium = medium_within(wax);
    CHECK(medium.extinction.g == Approx(2.0));
    CHECK(medium.anisotropy == -0.2f);
    CHECK(medium.scattering.r == 0.0f);
    // (1 - s^2) / (1 - g s^2), s = 4.09712 + 4.20863 c - sqrt(9.59217 + 41.6808 c + 17.7126 c^2)
    // with c = 0.5.
    const double s = 4.09712 + 4.20863 * 0.5 - std::sqrt(9.59217 + 41.6808 * 0.5 + 17.7126 * 0.25);
    CHECK(medium.scattering.g == Approx(2.0 * (1.0 - s * s) / (1.0 + 0.2 * s * s)).epsilon(1e-4));
    CHECK(medium.scattering.b == Approx(2.0).epsilon(1e-5));
    CHECK(medium.scattering.b <= medium.extinction.b);
    CHECK(medium.scatters());
    wax.thickness = 0.0f;
    CHECK(medium_within(wax).is_clear());
}

TEST_CASE("a dense body has its multi-scatter colour, whatever the anisotropy is", "[media]")
{
    // Light that falls evenly on a half space walks at random until it comes out again.
    const auto albedo = [](float color, float g) {
        const double scattered = static_cast<double>(single_scatter_albedo(Rgb(color), g).r);
        test::Random random(7);
        const auto uniform = [&random] { return static_cast<double>(random.next()); };
        constexpr int walks = 20000;
        double sum = 0.0;
        for (int walk = 0; walk < walks; ++walk) {
            double depth = 0.0;
            double mu = std::sqrt(1.0 - uniform());  // cosine of the way down
            double left = 1.0;
            while (left > 1e-3) {
                depth -= mu * std::log(1.0 - uniform());
                if (depth < 0.0) {
                    sum += left;
                    break;
                }
                left *= scattered;
                const double gd = static_cast<double>(g);
                const double q = (1.0 - gd * gd) / (1.0 - gd + 2.0 * gd * uniform());
                const double turn = std::abs(gd) < 1e-3 ? 2.0 * uniform() - 1.0
                                                        : (1.0 + gd * gd - q * q) / (2.0 * gd);
                const double across =
                    std::sqrt(std::max(0.0, (1.0 - mu * mu) * (1.0 - turn * turn)));
                mu = mu * turn + across * std::cos(6.283185307179586 * uniform());
            }
        }
        return sum / walks;
    };
    for (const float color : {0.25f, 0.5f, 0.8f}) {
        const auto expected = static_cast<double>(color);
        for (const float g : {-0.4f, 0.0f, 0.8f}) {
            CAPTURE(color, g);
            CHECK(albedo(color, g) == Approx(expected).margin(0.04));
        }
    }
}

}  // namespace bdpt::test::henyey_greenstein_test
