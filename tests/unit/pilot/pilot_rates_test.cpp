#include "pilot/pilot_rates.h"

#include "catch.hpp"
#include "pilot/pilot.h"

#include <algorithm>
#include <cmath>
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

/// Returns the greatest ratio of the noise of neighbouring blocks of 8 x 8 pixels, if all samples
/// are alike.
double steepest_step_of_noise(const SampleRates& rates)
{
    constexpr int side = 8;
    const auto noise = [&](int column, int row) {
        double variance = 0.0;
        for (int i = 0; i < side * side; ++i) {
            variance += 1.0 / static_cast<double>(
                                  rates.rate(side * column + i % side, side * row + i / side));
        }
        return std::sqrt(variance);
    };
    double steepest = 1.0;
    for (int row = 0; row + 1 < rates.height() / side; ++row) {
        for (int column = 0; column + 1 < rates.width() / side; ++column) {
            for (const double other : {noise(column + 1, row), noise(column, row + 1)}) {
                const double ratio = noise(column, row) / other;
                steepest = std::max({steepest, ratio, 1.0 / ratio});
            }
        }
    }
    return steepest;
}

TEST_CASE("no step of noise shows where rates change", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.camera, 30.0);
    std::mt19937 engine(7);
    for (PerCandidate<double>& cell : cells.camera) {
        cell[used] *= std::exponential_distribution<double>(1.0)(engine);
    }
    const auto rates = rates_of(cells);
    REQUIRE(rates != nullptr);
    CHECK(rates->least() == 0.5f);
    CHECK(rates->greatest() == 2.0f);
    CHECK(steepest_step_of_noise(*rates) < 1.3);
}

TEST_CASE("what is known to be background may have a sharp border", "[pilot]")
{
    CellErrors cells = equal_cells();
    for (std::size_t i = 0; i < grid().cells(); ++i) {
        const auto column = static_cast<int>(i % static_cast<std::size_t>(grid().columns()));
        if (column < grid().columns() / 2) {
            cells.camera[i][used] = 0.0;
            cells.scattering[i] = 0.0;
        }
    }
    const auto rates = rates_of(cells);
    REQUIRE(rates != nullptr);
    CHECK(rates->rate(196, 100) == 0.5f);
    CHECK(rates->rate(206, 100) >= 1.0f);
}

TEST_CASE("an island of a few bright cells is taken for chance", "[pilot]")
{
    const auto with_island = [](int side, double factor) {
        CellErrors cells = equal_cells();
        multiply_right(cells.camera, 30.0);
        for (int row = 20; row < 20 + side; ++row) {
            for (int column = 20; column < 20 + side; ++column) {
                cells.camera[grid().index(column, row)][used] *= factor;
            }
        }
        return rates_of(cells);
    };
    const auto mean_exponent = [](const SampleRates& rates, int cells) {
        const int x0 = 20 * rates.width() / grid().columns();
        const int y0 = 20 * rates.height() / grid().rows();
        const int side = cells * rates.width() / grid().columns();
        int sum = 0;
        for (int i = 0; i < side * side; ++i) {
            sum += rates.exponent(x0 + i % side, y0 + i / side);
        }
        return static_cast<double>(sum) / (side * side);
    };
    const auto few = with_island(3, 100.0);
    const auto many = with_island(16, 30.0);
    REQUIRE((few != nullptr && many != nullptr));
    CHECK(mean_exponent(*few, 3) < -0.9);
    CHECK(mean_exponent(*many, 16) > -0.4);
}

TEST_CASE("one rare bright path does not decide rates", "[pilot]")
{
    CellErrors cells = equal_cells();
    cells.camera[grid().index(20, 20)][used] = 1e6;
    CHECK(rates_of(cells) == nullptr);
}

}  // namespace bdpt::test::pilot_rates_test
