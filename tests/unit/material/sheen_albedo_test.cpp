#include "material/lobes/sheen.h"

#include "catch.hpp"
#include "layered_cases.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt::test::sheen_albedo_test {
namespace {

constexpr double exact_pi = 3.14159265358979323846;

/// The share that is reflected of light from this cosine, by many midpoints.
double albedo(const SheenAlbedo& sheen, double cosine, float roughness)
{
    constexpr int heights = 400;
    constexpr int azimuths = 200;
    const Vec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    double sum = 0.0;
    for (int i = 0; i < heights; ++i) {
        const double root = (i + 0.5) / heights;
        const double cos_i = root * root;
        const double sine = std::sqrt(1.0 - cos_i * cos_i);
        for (int j = 0; j < azimuths; ++j) {
            const double turn = exact_pi * (j + 0.5) / azimuths;
            const Vec3 wi(sine * std::cos(turn), sine * std::sin(turn), cos_i);
            sum += 2.0 * root * cos_i * static_cast<double>(sheen.value(wo, wi, roughness));
        }
    }
    return sum * 2.0 * exact_pi / (heights * azimuths);
}

}  // namespace

TEST_CASE("the tables of sheen hold what its formula reflects")
{
    const SheenAlbedo sheen;
    for (const float roughness : {0.1f, 0.24f, 0.5f, 0.77f, 1.0f}) {
        for (const float cosine : {0.004f, 0.03f, 0.1f, 0.4f, 0.9f, 1.0f}) {
            CAPTURE(roughness, cosine);
            const double expected = albedo(sheen, static_cast<double>(cosine), roughness);
            CHECK(sheen.directional(cosine, roughness) == Approx(expected).margin(0.005));
            CHECK(expected < 1.001);
        }
    }
}

TEST_CASE("sheen has the values worked out by hand")
{
    const SheenAlbedo sheen;
    // alpha = 1: D = 3 sin / (2 pi). At 45 degrees back to where the light comes from, sin of the
    // half vector is sqrt(1/2). Lambda(cos > 1/2) = exp(2 l(1/2) - l(1 - cos)), where
    // l(x) = 21.5473 / (1 + 3.82987 x^0.19823) - 1.9776 x - 4.32054.
    const double c = std::sqrt(0.5);
    const auto l = [](double x) {
        return 21.5473 / (1.0 + 3.82987 * std::pow(x, 0.19823)) - 1.9776 * x - 4.32054;
    };
    const double lambda = std::exp(2.0 * l(0.5) - l(1.0 - c));
    const double value = 3.0 * c / (2.0 * exact_pi) / (4.0 * c * c * (1.0 + 2.0 * lambda));
    const Vec3 w(c, 0.0, c);
    CHECK(sheen.value(w, w, 1.0f) == Approx(value).epsilon(1e-4));
    // Fibres are upright: nothing is reflected straight back, and straighter ones reflect less of
    // light that is not grazing.
    const Vec3 up(0.0f, 0.0f, 1.0f);
    CHECK(sheen.value(up, up, 0.5f) < 1e-6f);
    CHECK(sheen.directional(0.7f, 0.2f) < sheen.directional(0.7f, 0.9f));
    // The least roughness.
    CHECK(sheen.value(w, w, 0.0f) == sheen.value(w, w, SheenAlbedo::min_roughness));
}

TEST_CASE("sheen is the formula of the extension, but where that makes light")
{
    const SheenAlbedo sheen;
    // roughness 0.25, alpha 0.0625: the formula reflects more of grazing light than arrives.
    constexpr double alpha = 0.0625;
    const double share = (1.0 - alpha) * (1.0 - alpha);
    const auto mix = [&](double a, double b) { return a + share * (b - a); };
    const auto l = [&](double x) {
        return mix(21.5473, 25.3245) /
                   (1.0 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
               mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
    };
    const auto lambda = [&](double cosine) {
        return cosine < 0.5 ? std::exp(l(cosine)) : std::exp(2.0 * l(0.5) - l(1.0 - cosine));
    };
    for (const double cos_o : {0.3, 0.6, 0.95}) {
        for (const double cos_i : {0.25, 0.5, 0.8}) {
            const Vec3 wo(std::sqrt(1.0 - cos_o * cos_o), 0.0, cos_o);
            const Vec3 wi(0.0, std::sqrt(1.0 - cos_i * cos_i), cos_i);
            const Vec3 h = wo + wi;
            const double sine2 = static_cast<double>((h.x * h.x + h.y * h.y) / dot(h, h));
            const double d = (2.0 + 1.0 / alpha) * std::pow(sine2, 0.5 / alpha) / (2.0 * exact_pi);
            CAPTURE(cos_o, cos_i);
            CHECK(sheen.value(wo, wi, 0.25f) ==
                  Approx(d / (4.0 * cos_o * cos_i * (1.0 + lambda(cos_o) + lambda(cos_i))))
                      .epsilon(2e-4));
        }
    }
    for (const double cosine : {0.002, 0.01, 0.05, 0.1, 0.2}) {
        CAPTURE(cosine);
        CHECK(albedo(sheen, cosine, 0.25f) < 1.001);
    }
}

TEST_CASE("below a sheen the base is scaled as the extension has it")
{
    // E is the integral of the extension's formula by 180,000 midpoints, worked out by another
    // program: rows of roughness 0.25, 0.5 and 1, columns of cosine 0.1, 0.4 and 0.7.
    constexpr float roughness[]{0.25f, 0.5f, 1.0f};
    constexpr double cosine[]{0.1, 0.4, 0.7};
    constexpr double albedos[3][3]{
        {0.5485, 0.1084, 0.0147}, {0.5666, 0.2468, 0.1049}, {0.7205, 0.4176, 0.2643}};
    const SheenAlbedo albedo;
    const Rgb color(0.2f, 0.8f, 0.5f);
    const Rgb base(0.6f, 0.3f, 0.9f);
    for (std::size_t row = 0; row < 3; ++row) {
        const TestedBsdf bsdf({"sheen", {base, 0, 1, 0}, 1.5f, sheen(color, roughness[row])});
        for (std::size_t o = 0; o < 3; ++o) {
            CHECK(albedo.directional(static_cast<float>(cosine[o]), roughness[row]) ==
                  Approx(albedos[row][o]).margin(0.003));
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 wo(std::sqrt(1.0 - cosine[o] * cosine[o]), 0.0, cosine[o]);
                const Vec3 wi(0.0, std::sqrt(1.0 - cosine[i] * cosine[i]), cosine[i]);
                const double left = std::min(1.0 - 0.8 * albedos[row][o],  // the brightest channel
                                             1.0 - 0.8 * albedos[row][i]);
                const Rgb found = bsdf.eval(wo, wi, TransportMode::radiance).f_cos;
                for (int c = 0; c < 3; ++c) {
                    const auto fibres =
                        static_cast<double>(color[c] * albedo.value(wo, wi, roughness[row]));
                    const double expected =
                        cosine[i] * (fibres + left * static_cast<double>(base[c]) / exact_pi);
                    CAPTURE(roughness[row], cosine[o], cosine[i], c);
                    CHECK(static_cast<double>(found[c]) == Approx(expected).epsilon(0.005));
                }
            }
        }
    }
}

}  // namespace bdpt::test::sheen_albedo_test
