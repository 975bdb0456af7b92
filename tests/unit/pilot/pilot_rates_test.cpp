#include "pilot/pilot_rates.h"

#include "catch.hpp"
#include "pilot/pilot.h"

#include <cstddef>
#include <memory>
#include <random>

namespace bdpt::test::pilot_rates_test {
namespace {

constexpr std::size_t used = 3;  // the candidate that renders

PilotGrid grid()
{
    return {400, 200};
}

/// Equal errors and costs in all cells of the candidate in use; of others, such as to mislead.
CellErrors equal_cells()
{
    CellErrors cells{.camera = std::vector<PerCandidate<double>>(grid().cells()),
                     .costs = std::vector<PerCandidate<double>>(grid().cells()),
                     .scattering = std::vector<double>(grid().cells(), 1.0)};
    for (std::size_t i = 0; i < grid().cells(); ++i) {
        cells.camera[i].fill(i % 100 == 0 ? 1000.0 : 0.0);
        cells.costs[i].fill(static_cast<double>(1 + i % 7));
        cells.camera[i][used] = 1.0;
        cells.costs[i][used] = 100.0;
    }
    return cells;
}

/// Multiplies values of the cells in the right half of the image.
void multiply_right(std::vector<PerCandidate<double>>& values, double factor)
{
    for (int row = 0; row < grid().rows(); ++row) {
        for (int column = grid().columns() / 2; column < grid().columns(); ++column) {
            values[grid().index(column, row)][used] *= factor;
        }
    }
}

std::shared_ptr<const SampleRates> rates_of(const CellErrors& cells)
{
    return choose_rates(grid(), cells, used);
}

}  // namespace

TEST_CASE("an image of even noise has no rates", "[pilot]")
{
    CHECK(rates_of(equal_cells()) == nullptr);
    CellErrors none = equal_cells();
    for (PerCandidate<double>& cell : none.camera) {
        cell[used] = 0.0;
    }
    CHECK(rates_of(none) == nullptr);
    // Differences of samples that are no differences of cells.
    CellErrors noisy = equal_cells();
    std::mt19937 engine(1);
    for (PerCandidate<double>& cell : noisy.camera) {
        cell[used] = std::exponential_distribution<double>(1.0)(engine);
    }
    CHECK(rates_of(noisy) == nullptr);
}

TEST_CASE("no cell takes more samples where light is so rare that its error is chance", "[pilot]")
{
    PilotResult pilot;
    pilot.cells = equal_cells();
    multiply_right(pilot.cells.camera, 30.0);
    RenderOptions options;
    options.film.width = grid().width();
    options.film.height = grid().height();
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = candidates[used].light_paths;
    options.bidirectional.connections = candidates[used].connections;
    options.bidirectional.connection_rays = candidates[used].connection_rays;
    CHECK(best_rates(pilot, options) != nullptr);
    pilot.light_is_rare = true;
    CHECK(best_rates(pilot, options) == nullptr);
}

TEST_CASE("noisy cells take more samples", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.camera, 30.0);
    const auto rates = rates_of(cells);
    REQUIRE(rates != nullptr);
    CHECK(rates->width() == 400);
    CHECK(rates->height() == 200);
    CHECK(rates->mean() <= 1.0);
    CHECK(rates->mean() > 0.99);
    CHECK(rates->rate(50, 100) == 0.5f);
    CHECK(rates->rate(350, 100) >= 1.0f);
    CHECK(rates->greatest() == 2.0f);
    CHECK(rates->least() == 0.5f);
}

TEST_CASE("expensive cells take fewer samples", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.costs, 30.0);
    const auto rates = rates_of(cells);
    REQUIRE(rates != nullptr);
    CHECK(rates->rate(350, 100) == 0.5f);
    CHECK(rates->rate(50, 100) >= 1.0f);
    // As much dearer as noisier: even.
    multiply_right(cells.camera, 30.0);
    CHECK(rates_of(cells) == nullptr);
}

TEST_CASE("rates help little where splats are the noise", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.camera, 30.0);
    cells.splats[used] = 100.0;
    CHECK(rates_of(cells) == nullptr);
}

TEST_CASE("rates help little where dots are the noise", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.camera, 30.0);
    cells.dots[used] = 100.0;
    CHECK(rates_of(cells) == nullptr);
}

TEST_CASE("dots are the noise of cells where paths scatter", "[pilot]")
{
    const auto before_background = [](double part) {
        CellErrors cells = equal_cells();
        for (std::size_t i = 0; i < grid().cells(); ++i) {
            const auto column = static_cast<int>(i % static_cast<std::size_t>(grid().columns()));
            if (column < (1.0 - part) * grid().columns()) {
                cells.camera[i][used] = 0.0;
                cells.costs[i][used] = 50.0;
                cells.scattering[i] = 0.0;
            }
        }
        cells.dots[used] = 100.0;
        return cells;
    };
    const auto rates = rates_of(before_background(0.3));
    REQUIRE(rates != nullptr);
    CHECK(rates->rate(50, 100) == 0.5f);
    CHECK(rates->rate(390, 100) == 2.0f);
    // Samples that the object cannot take are those of the background.
    const auto of_small = rates_of(before_background(0.1));
    REQUIRE(of_small != nullptr);
    CHECK(of_small->mean() > 0.99);
}

TEST_CASE("one rare bright path does not decide rates", "[pilot]")
{
    CellErrors cells = equal_cells();
    cells.camera[grid().index(20, 20)][used] = 1e6;
    CHECK(rates_of(cells) == nullptr);
}

}  // namespace bdpt::test::pilot_rates_test
