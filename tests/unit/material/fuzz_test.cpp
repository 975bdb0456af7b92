#include "material/lobes/fuzz.h"

#include "catch.hpp"
#include "layered_cases.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt::test::fuzz_test {
namespace {

constexpr double exact_pi = 3.14159265358979323846;

Vec3 at(double cosine, double azimuth = 0.0)
{
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

/// Calls `visit` with many directions and the solid angle of each times its cosine.
template <typename Visit>
void for_each_direction(const Visit& visit)
{
    constexpr int heights = 300;
    constexpr int azimuths = 200;
    for (int i = 0; i < heights; ++i) {
        const double root = (i + 0.5) / heights;
        for (int j = 0; j < azimuths; ++j) {
            visit(at(root * root, exact_pi * (j + 0.5) / azimuths),
                  4.0 * root * root * root * exact_pi / (heights * azimuths));
        }
    }
}

double albedo(const FuzzTable& fuzz, double cosine, float roughness)
{
    double sum = 0.0;
    for_each_direction([&](Vec3 wi, double weight) {
        sum += weight * static_cast<double>(fuzz.value(at(cosine), wi, roughness));
    });
    return sum;
}

}  // namespace

TEST_CASE("fibres reflect what the tables of their paper say")
{
    // R of ltc_table_sheen_volume (github.com/tizian/ltc-sheen, Apache-2.0): row and column of 32
    // evenly spaced roughnesses and cosines. MaterialX' fits are within 0.03 of it.
    struct Node {
        int row;
        int column;
        double reflectance;
    };
    const Node nodes[]{{5, 0, 0.67021},  {5, 5, 0.07375},   {5, 14, 0.00059},  {8, 0, 0.69794},
                       {8, 3, 0.39802},  {8, 10, 0.05252},  {8, 31, 0.00030},  {11, 0, 0.69766},
                       {11, 3, 0.48615}, {11, 10, 0.15141}, {11, 20, 0.01807}, {11, 31, 0.00224}};
    const FuzzTable fuzz;
    for (const Node& node : nodes) {
        const double cosine = node.column / 31.0;
        const float roughness = static_cast<float>(node.row) / 31.0f;
        CAPTURE(node.row, node.column);
        CHECK(static_cast<double>(FuzzTable::directional(static_cast<float>(cosine), roughness)) ==
              Approx(node.reflectance).margin(0.03));
    }
}

TEST_CASE("the reciprocal lobe of fibres has the albedo of the paper's")
{
    const FuzzTable fuzz;
    for (const float roughness : {0.1f, 0.105f, 0.15f, 0.24f, 0.5f, 0.77f, 1.0f}) {
        for (const float cosine : {0.001f, 0.01f, 0.05f, 0.1f, 0.4f, 0.9f, 1.0f}) {
            CAPTURE(roughness, cosine);
            const double expected = albedo(fuzz, static_cast<double>(cosine), roughness);
            CHECK(static_cast<double>(FuzzTable::directional(cosine, roughness)) ==
                  Approx(expected).margin(0.004));
        }
    }
}

TEST_CASE("fibres have the values of the paper's lobe where that is reciprocal")
{
    // Straight down and back at roughness 1, b is 0 and both lobes are one: R a^2 / pi, for row and
    // column 31 of the fits: a = (2.58126 + 0.813703) / (1 + 0.310327 + 2.60994).
    const FuzzTable fuzz;
    const double a = 3.394963 / 3.920267;
    const Vec3 up(0.0f, 0.0f, 1.0f);
    const double r = static_cast<double>(FuzzTable::directional(1.0f, 1.0f));
    CHECK(r == Approx(0.3445).epsilon(0.003));
    // At w = +z, M^-1 w = w: the density over the cosine is a^2 / pi.
    CHECK(static_cast<double>(fuzz.value(up, up, 1.0f)) ==
          Approx(r * a * a / exact_pi).epsilon(0.02));
    // Light comes back towards the eye: fibres are seen and lit from one side.
    for (const float roughness : {0.3f, 0.6f, 0.9f}) {
        const double here = static_cast<double>(fuzz.value(at(0.3), at(0.3), roughness));
        const double across =
            static_cast<double>(fuzz.value(at(0.3), at(0.3, exact_pi), roughness));
        CHECK(here > 1.1 * across);
    }
    CHECK(fuzz.value(up, at(0.5), 0.0f) == fuzz.value(up, at(0.5), FuzzTable::min_roughness));
}

TEST_CASE("samples of fibres have small weights")
{
    const FuzzTable fuzz;
    for (const float roughness : {0.1f, 0.2f, 0.5f, 1.0f}) {
        for (const double cosine : {0.005, 0.05, 0.3, 1.0}) {
            test::Random random(3);
            double largest = 0.0;
            for (int i = 0; i < 20000; ++i) {
                const Vec3 wi = FuzzTable::sample(at(cosine), roughness, random.next_2d());
                const FuzzTable::Value value = fuzz.eval(at(cosine), wi, roughness);
                largest = std::max(largest, static_cast<double>(value.f * wi.z / value.pdf_fwd));
            }
            CAPTURE(roughness, cosine, largest);
            CHECK(largest < 2.5);
        }
    }
}

TEST_CASE("below fibres a base is scaled by what they do not keep")
{
    // Also below black ones, and the brightest channel of a sheen.
    const Rgb base(0.6f, 0.3f, 0.9f);
    for (const float roughness : {0.25f, 0.5f, 1.0f}) {
        const test::TestedBsdf bsdf(
            {"soot", {base, 0, 1, 0}, 1.5f, test::fuzzy(0.8f, Rgb(0.0f), roughness)});
        for (const double cosine : {0.1, 0.4, 0.9}) {
            Rgb sum(0.0f);
            for_each_direction([&](Vec3 wi, double weight) {
                sum += bsdf.eval(at(cosine), wi, TransportMode::radiance).f_cos *
                       (static_cast<float>(weight) / wi.z);
            });
            const float left =
                1.0f - 0.8f * FuzzTable::directional(static_cast<float>(cosine), roughness);
            CAPTURE(roughness, cosine);
            for (int c = 0; c < 3; ++c) {
                CHECK(sum[c] == Approx(left * base[c]).epsilon(0.005));
            }
        }
    }
}

}  // namespace bdpt::test::fuzz_test
