#include "geometry/spherical_triangle.h"

#include "catch.hpp"
#include "statistics.h"

#include <array>
#include <cmath>

namespace bdpt::spherical_triangle_test {

TEST_CASE("spherical triangle: an octant covers an eighth of all directions", "[geometry]")
{
    const SphericalTriangle octant({Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 0.5f)});
    CHECK(octant.solid_angle() == Approx(0.5f * pi).epsilon(1e-6));
    const Vec2 at = octant.barycentrics(normalize(Vec3(1.0f, 1.5f, 0.0f)));
    CHECK(at.x == Approx(0.5f));
    CHECK(at.y == 0.0f);
}

TEST_CASE("spherical triangle: samples are uniform in the solid angle", "[geometry]")
{
    test::Random random(31);
    for (int i = 0; i < 40; ++i) {
        std::array<Vec3, 3> corners;
        for (Vec3& corner : corners) {
            corner = random.direction() * (0.3f + random.next());
        }
        const SphericalTriangle whole(corners);
        if (whole.solid_angle() < 0.03f) {
            continue;
        }
        // Cut in two pieces, from each corner in turn.
        for (std::size_t first = 0; first < 3; ++first) {
            const Vec3 a = corners[first];
            const Vec3 b = corners[(first + 1) % 3];
            const Vec3 c = corners[(first + 2) % 3];
            const Vec3 cut = glm::mix(b, c, 0.3f);
            const double share = static_cast<double>(SphericalTriangle({a, b, cut}).solid_angle()) /
                                 static_cast<double>(whole.solid_angle());
            constexpr int samples = 20000;
            int inside = 0;
            for (int k = 0; k < samples; ++k) {
                const Vec3 w = whole.sample(random.next_2d());
                REQUIRE(std::abs(length(w) - 1.0f) < 1e-4f);
                // The point of the triangle in this direction.
                const Vec2 at = whole.barycentrics(w);
                const Vec3 p = corners[0] + at.x * (corners[1] - corners[0]) +
                               at.y * (corners[2] - corners[0]);
                REQUIRE(length(normalize(p) - w) < 2e-3f);
                inside += dot(w, cross(a, cut)) * dot(b, cross(a, cut)) > 0.0f ? 1 : 0;
            }
            CAPTURE(i, first, share, whole.solid_angle());
            const double spread = std::sqrt(share * (1.0 - share) / samples);
            CHECK(std::abs(static_cast<double>(inside) / samples - share) < 5.0 * spread + 1e-4);
        }
    }
}

}  // namespace bdpt::spherical_triangle_test
