#include "bsdf_cases.h"
#include "catch.hpp"
#include "chi_square.h"
#include "direction_bins.h"

#include <optional>
#include <vector>

namespace bdpt::test::bsdf_chi_square_test {

TEST_CASE("samples of every BSDF are distributed by its density", "[long]")
{
    const std::vector<test::BsdfCase> cases = test::bsdf_cases();
    const std::vector<Vec3> directions = test::bsdf_directions();
    const double significance =
        test::sidak(0.01, static_cast<int>(cases.size() * directions.size()));
    constexpr int samples = 120000;
    int tested = 0;
    for (const test::BsdfCase& bsdf_case : cases) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const Vec3 wo : directions) {
            if (wo.z < 0.0f && bsdf_case.surface.body == Body::thin_walled) {
                continue;  // the same from both sides: bsdf_symmetry_test
            }
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z);
            const std::optional ior(bsdf_case.ior);
            const test::Axes axes = test::axes_of(bsdf_case.refracts() ? ior : std::nullopt, wo);
            const std::vector<double> expected = test::bin_probabilities(bsdf, axes, wo);
            const std::vector<double> counts = test::bin_counts(bsdf, axes, wo, samples);
            if (expected.back() > 0.9999) {
                CHECK(counts.back() == samples);  // all lobes are delta
                continue;
            }
            const test::ChiSquare test = test::chi_square(counts, expected);
            CAPTURE(test.statistic, test.degrees, expected.back());
            CHECK(test.p_value > significance);
            CHECK(test.degrees >= 10);
            CHECK(test.min_detectable(significance) < 0.05);
            ++tested;
        }
    }
    CHECK(tested >= 80);
}

}  // namespace bdpt::test::bsdf_chi_square_test
