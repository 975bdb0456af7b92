#include "catch.hpp"
#include "chi_square.h"
#include "mapped_cases.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace bdpt::test::mapped_chi_square_test {
namespace {

// Bins of the sphere, even in the angle from the normal and the azimuth; those above and below the
// surface are apart.
constexpr int rings = 16;
constexpr int sectors = 20;
constexpr int fine = 12;  // midpoints along each side of a bin
constexpr double two_pi = 6.283185307179586;

std::size_t bin_of(Vec3 w)
{
    const double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / two_pi;
    const double angle = std::acos(std::clamp(static_cast<double>(w.z), -1.0, 1.0));
    const int ring = std::clamp(static_cast<int>(2.0 * angle / two_pi * rings), 0, rings - 1);
    const int sector = std::clamp(static_cast<int>((turn + 0.5) * sectors), 0, sectors - 1);
    return static_cast<std::size_t>(ring * sectors + sector);
}

/// The last one: no sample, or that of a delta lobe.
std::vector<double> probabilities(const Bsdf& bsdf, TransportMode mode)
{
    std::vector<double> result(rings * sectors + 1);
    constexpr double step = 0.5 * two_pi / (rings * fine);
    for (int i = 0; i < rings * fine; ++i) {
        const double z = std::cos((i + 0.5) * step);
        const double r = std::sin((i + 0.5) * step);
        const double area = r * step * two_pi / (sectors * fine);
        for (int j = 0; j < sectors * fine; ++j) {
            const double phi = ((j + 0.5) / (sectors * fine) - 0.5) * two_pi;
            const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
            result[static_cast<std::size_t>(i / fine * sectors + j / fine)] +=
                area * static_cast<double>(bsdf.eval(w, mode).pdf_fwd.value);
        }
    }
    const double rest = 1.0 - std::accumulate(result.begin(), result.end(), 0.0);
    CHECK(rest > -0.01);
    result.back() = std::max(rest, 1e-7);
    for (double& probability : result) {
        probability = std::max(probability, 1e-7);
    }
    return result;
}

/// Surfaces rough enough for these bins.
bool is_tested(const std::string& name)
{
    const std::vector<std::string> names{"lambert",
                                         "dielectric 0.6 half specular",
                                         "metal 1",
                                         "solid glass 0.8 ior 1.33",
                                         "thin half transmission 0.4",
                                         "all at once",
                                         "smooth coat on dielectric 0.5",
                                         "coat 1 on black",
                                         "sheen 0.5 on lambert",
                                         "brushed dielectric 0.4",
                                         "translucent dielectric 0.4"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

TEST_CASE("samples over normal maps are distributed by their density, from both ends", "[long]")
{
    constexpr int samples = 70000;
    constexpr double significance = 2e-5;  // of some 300 tests
    int tested = 0;
    for (const test::BsdfCase& what : test::bsdf_cases()) {
        if (!is_tested(what.name)) {
            continue;
        }
        ++tested;
        for (const float lean : test::leans()) {
            const test::MappedSurface surface(what, lean);
            for (const auto mode : {TransportMode::radiance, TransportMode::importance}) {
                for (const Vec3 wo : test::bsdf_directions()) {
                    CAPTURE(what.name, lean, mode, wo.x, wo.y, wo.z);
                    const Bsdf bsdf = surface.seen_from(wo);
                    const std::vector<double> expected = probabilities(bsdf, mode);
                    std::vector<double> counts(expected.size());
                    test::Random random(109);
                    for (int i = 0; i < samples; ++i) {
                        const float u_lobe = random.next();
                        const auto sampled = bsdf.sample(u_lobe, random.next_2d(), mode);
                        counts[sampled && !sampled->delta ? bin_of(sampled->wi)
                                                          : counts.size() - 1] += 1.0;
                    }
                    if (expected.back() > 0.999) {
                        CHECK(counts.back() == samples);  // light from behind the facet
                        continue;
                    }
                    const test::ChiSquare test = test::chi_square(counts, expected);
                    CAPTURE(test.statistic, test.degrees, expected.back());
                    CHECK(test.p_value > significance);
                    CHECK(test.min_detectable(significance) < 0.06);
                }
            }
        }
    }
    CHECK(tested == 11);
}

}  // namespace bdpt::test::mapped_chi_square_test
