#include "math/warp.h"

#include "catch.hpp"
#include "chi_square.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <vector>

namespace bdpt::test::warp_test {
namespace {

constexpr int grid = 16;
constexpr int samples = 200000;
constexpr double significance = 1e-3;

std::size_t cell(double a, double b)
{
    const auto index = [](double x) {
        return static_cast<std::size_t>(
            std::min(grid - 1, std::max(0, static_cast<int>(x * grid))));
    };
    return index(a) * grid + index(b);
}

/// Maps random points into [0, 1]^2 by coordinates in which they should be uniform.
void check_uniform(const std::function<Vec2(Vec2)>& coordinates)
{
    test::Random random(17);
    std::vector<double> counts(grid * grid);
    for (int i = 0; i < samples; ++i) {
        const Vec2 p = coordinates(random.next_2d());
        REQUIRE((p.x >= -1e-5f && p.x <= 1.00001f && p.y >= -1e-5f && p.y <= 1.00001f));
        counts[cell(static_cast<double>(p.x), static_cast<double>(p.y))] += 1.0;
    }
    const std::vector<double> expected(counts.size(), 1.0 / (grid * grid));
    const test::ChiSquare test = test::chi_square(counts, expected);
    CHECK(test.p_value > significance);
    CHECK(test.min_detectable(significance) < 0.04);
}

float turn_of(float x, float y)
{
    return std::atan2(y, x) / 6.2831853f + 0.5f;
}

/// Integral of a density of the direction over the sphere, by midpoints.
double integral(const std::function<float(Vec3)>& pdf)
{
    constexpr int heights = 20000;
    double sum = 0.0;
    for (int i = 0; i < heights; ++i) {
        const double z = -1.0 + 2.0 * (i + 0.5) / heights;
        sum += static_cast<double>(pdf(Vec3(std::sqrt(1.0 - z * z), 0.0, z)));
    }
    return sum * 4.0 * 3.14159265358979 / heights;
}

}  // namespace

TEST_CASE("square_to_disk is uniform")
{
    check_uniform([](Vec2 u) {
        const Vec2 p = square_to_disk(u);
        return Vec2{p.x * p.x + p.y * p.y, turn_of(p.x, p.y)};
    });
    CHECK(square_to_disk({0.5f, 0.5f}) == Vec2{0.0f, 0.0f});
}

TEST_CASE("square_to_cosine_hemisphere goes with the cosine")
{
    check_uniform([](Vec2 u) {
        const Vec3 w = square_to_cosine_hemisphere(u);
        REQUIRE(w.z >= 0.0f);
        REQUIRE(dot(w, w) == Approx(1.0).epsilon(1e-5));
        return Vec2{w.z * w.z, turn_of(w.x, w.y)};  // the integral of 2 cos d(cos)
    });
    CHECK(integral([](Vec3 w) { return cosine_hemisphere_pdf(w.z).value; }) == Approx(1.0));
}

TEST_CASE("square_to_triangle is uniform")
{
    check_uniform([](Vec2 u) {
        const Vec2 b = square_to_triangle(u);
        REQUIRE((b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f));
        const float rest = 1.0f - b.x;  // of area rest^2, and along it b.y is uniform
        return Vec2{rest * rest, rest > 0.0f ? b.y / rest : 0.0f};
    });
}

TEST_CASE("square_to_cone is uniform from needles to the sphere")
{
    for (const float depth : {1e-12f, 1e-4f, 0.5f, 1.0f, 2.0f}) {
        CAPTURE(depth);
        check_uniform([depth](Vec2 u) {
            const Vec3 w = square_to_cone(u, depth);
            REQUIRE(dot(w, w) == Approx(1.0).epsilon(1e-5));
            // 1 - z has lost its digits in a narrow cone, the sine has not.
            const double sin2 = static_cast<double>(w.x) * static_cast<double>(w.x) +
                                static_cast<double>(w.y) * static_cast<double>(w.y);
            const double own = w.z > 0.0f ? sin2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - sin2)))
                                          : 1.0 - static_cast<double>(w.z);
            return Vec2{static_cast<float>(own / static_cast<double>(depth)), turn_of(w.x, w.y)};
        });
    }
    CHECK(integral([](Vec3 w) { return w.z > 0.75f ? cone_pdf(0.25f).value : 0.0f; }) ==
          Approx(1.0).epsilon(1e-3));
    CHECK(integral([](Vec3) { return cone_pdf(2.0f).value; }) == Approx(1.0));
    CHECK(square_to_cone({0.5f, 0.5f}, 2.0f) == Vec3{0.0f, 0.0f, 1.0f});
}

TEST_CASE("one_minus_cos keeps the digits of narrow cones")
{
    for (const double angle : {1e-8, 1e-4, 0.1, 1.0}) {
        const double sine = std::sin(angle);
        const double exact = 2.0 * std::sin(0.5 * angle) * std::sin(0.5 * angle);
        CHECK(one_minus_cos(static_cast<float>(sine * sine)) == Approx(exact).epsilon(1e-6));
    }
}

}  // namespace bdpt::test::warp_test
