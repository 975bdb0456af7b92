#include "pilot/pilot_errors.h"

#include "catch.hpp"
#include "pilot/qmc_variance_factor.h"

#include <cstddef>
#include <vector>

namespace bdpt::test::pilot_errors_test {
namespace {

constexpr float radiance = 3.0f;

/// Camera paths of one sample find two lights each, by next-event estimation alone; those of the
/// other sample find nothing.
class TwoLights final : public Integrator {
public:
    explicit TwoLights(int edges) : edges_(edges), shares_(static_cast<std::size_t>(edges) + 2)
    {
        shares_[1] = 1.0f;
    }
    RenderStats render_tile(const Tile& /*tile*/, SampleRange samples,
                            const Films& films) const override
    {
        for (int i = 0; i < 2 && samples.begin == 0; ++i) {
            films.on_path({.strategy = {.s = 1, .t = edges_},
                           .raster = Vec2(0.5f),
                           .unweighted = Rgb(radiance),
                           .weight = 1.0f,
                           .shares = shares_});
        }
        return {};
    }

private:
    int edges_;
    std::vector<float> shares_;
};

/// In an image of one pixel.
PilotContributions contributions_of(const TwoLights& lights)
{
    PilotContributions contributions{
        .grid = PilotGrid(1, 1), .light_paths = 1.0, .rows = std::vector<PilotRow>(1), .parts = {}};
    for (int index = 0; index < PilotRow::samples_of_cell; ++index) {
        contributions.rows[0].render(lights, contributions.grid, Heuristic::power, 0, index,
                                     contributions.light_paths);
    }
    return contributions;
}

}  // namespace

TEST_CASE("of the variance of sums a part is left, of direct light another than of the rest",
          "[pilot]")
{
    const bool direct = GENERATE(true, false);
    CAPTURE(direct);
    const PilotContributions contributions = contributions_of(TwoLights(direct ? 2 : 3));
    const PilotBrightness brightness(contributions);
    const double scale = brightness.scale(0);
    REQUIRE(contributions.rows[0].joined().size() == 2);
    const PerCandidate<double> of_one_path =
        remaining_errors(contributions.rows[0].joined()[0].shares, scale);
    // Sums of 2 L and of 0: the products of different paths of a sample are 2 L^2 and 0.
    const double variance_of_sums = static_cast<double>(radiance * radiance);
    const double left = direct ? left_of_direct_sums : left_of_indirect_sums;
    constexpr double with_unseen = 1.2;
    const PerCandidate<double> errors = predicted_errors(contributions, brightness);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        CHECK(errors[k] / with_unseen == Approx(of_one_path[k] + left * scale * variance_of_sums));
    }
}

}  // namespace bdpt::test::pilot_errors_test
