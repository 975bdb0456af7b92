#include "material/specular_albedo.h"

#include "catch.hpp"
#include "material/lobes/ggx.h"

#include <cmath>
#include <cstdint>

namespace bdpt::test::white_albedo_test {
namespace {

/// The light that white microfacets reflect at once, by importance samples on a lattice: the mean
/// of f cos over the density, in which D cancels.
double integrate(double cosine, float roughness)
{
    constexpr std::int64_t points = 6765;  // Fibonacci numbers
    constexpr std::int64_t step = 4181;
    const float alpha = roughness * roughness;
    const Vec3 wo{static_cast<float>(std::sqrt(1.0 - cosine * cosine)), 0.0f,
                  static_cast<float>(cosine)};
    double sum = 0.0;
    for (std::int64_t i = 0; i < points; ++i) {
        const Vec2 u{(static_cast<float>(i) + 0.5f) / static_cast<float>(points),
                     (static_cast<float>(i * step % points) + 0.5f) / static_cast<float>(points)};
        const ggx::Microfacet facet = ggx::visible_microfacet(wo, alpha, u);
        const Vec3 wi = facet.reflected();
        if (wi.z > 0.0f) {
            const float stretch = ggx::stretch(wo, alpha);
            sum += static_cast<double>(wi.z * (wo.z + stretch) /
                                       (wi.z * stretch + wo.z * ggx::stretch(wi, alpha)));
        }
    }
    return sum / static_cast<double>(points);
}

/// The cosine-weighted average of the table.
double average(float roughness)
{
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps;
        const auto cosine = static_cast<float>(root * root);
        sum += 4.0 * root * root * root *
               static_cast<double>(WhiteAlbedo::directional(cosine, roughness)) / steps;
    }
    return sum;
}

}  // namespace

TEST_CASE("no rough white metal makes light, at any roughness and angle, and none loses much")
{
    // Between the nodes of the table; the first roughness is the least of rough surfaces.
    for (int i = 0; i <= 60; ++i) {
        const float roughness = 0.0317f + 0.9683f * static_cast<float>(i) / 60.0f;
        // What is not reflected at once leaves in proportion to what is missing elsewhere.
        const double again = (1.0 - average(roughness)) /
                             (1.0 - static_cast<double>(WhiteAlbedo::average(roughness)));
        for (const double degrees :
             {0.0,  7.3,  19.1, 28.3, 38.9, 47.7, 56.1, 63.7, 70.9, 75.3,  79.1,
              82.3, 84.7, 86.1, 87.0, 87.9, 88.6, 89.2, 89.6, 89.8, 89.93, 89.98}) {
            CAPTURE(roughness, degrees);
            const double cosine = std::cos(degrees * 3.14159265358979 / 180.0);
            const double once = integrate(cosine, roughness);
            const double missing = 1.0 - static_cast<double>(WhiteAlbedo::directional(
                                             static_cast<float>(cosine), roughness));
            const double reflected = once + missing * again;
            CHECK(reflected <= 1.0005);
            CHECK(reflected >= (degrees < 89.9 ? 0.998 : 0.995));
        }
    }
}

TEST_CASE("the albedo of white microfacets of alpha 1, seen straight, is 1 - log 2")
{
    CHECK(WhiteAlbedo::directional(1.0f, 1.0f) == Approx(1.0 - std::log(2.0)).margin(3e-4));
}

}  // namespace bdpt::test::white_albedo_test
