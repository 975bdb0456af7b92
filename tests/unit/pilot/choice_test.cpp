#include "pilot/pilot.h"

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>

namespace bdpt::test::choice_test {
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
    PilotMeasurements pilot;
    pilot.grid = grid();
    pilot.cells = cells;
    return choose_rates(pilot, used);
}

std::size_t index_of(double light_paths, double connections, double rays = 0.0)
{
    const auto found =
        std::find(candidates.begin(), candidates.end(), Candidate{light_paths, connections, rays});
    REQUIRE(found != candidates.end());
    return static_cast<std::size_t>(found - candidates.begin());
}

/// Returns predictions that are the same for all candidates.
PilotMeasurements equal_candidates()
{
    PilotMeasurements pilot;
    pilot.errors.fill(1.0);
    pilot.costs.fill(10.0);
    return pilot;
}

Candidate chosen_by(const PilotMeasurements& pilot)
{
    return candidates[choose(pilot)];
}

}  // namespace

TEST_CASE("of the best at equal cost, the one that fits into memory is taken", "[pilot]")
{
    PilotMeasurements pilot = equal_candidates();
    pilot.errors[index_of(0.0625, 1.0)] = 0.1;
    pilot.errors[index_of(1.0, 1.0)] = 0.5;
    CHECK(chosen_by(pilot) == Candidate{0.0625, 1.0});
    pilot.ruled_out[index_of(0.0625, 1.0)] = true;
    CHECK(chosen_by(pilot) == Candidate{1.0, 1.0});
    pilot.costs[0] = 0.5;
    CHECK(chosen_by(pilot) == Candidate{0.0, 0.0});
}

TEST_CASE("connections are chosen where that has the least product of error and cost", "[pilot]")
{
    PilotMeasurements pilot = equal_candidates();
    pilot.errors[index_of(0.0625, 1.0)] = 0.1;
    pilot.errors[index_of(0.0625, 8.0, 8.0)] = 0.101;
    CHECK(chosen_by(pilot) == Candidate{0.0625, 1.0});
    pilot.errors[index_of(0.0625, 8.0, 8.0)] = 0.099;
    CHECK(chosen_by(pilot) == Candidate{0.0625, 8.0, 8.0});
}

TEST_CASE("some candidates are taken only for a gain that exceeds the noise of the prediction",
          "[pilot]")
{
    const std::size_t usual = index_of(0.0625, 1.0);
    const std::size_t other = GENERATE_COPY(index_of(0.0625, 8.0, 8.0), index_of(2.0, 0.0));
    PilotMeasurements pilot = equal_candidates();
    pilot.errors[usual] = 0.1;
    pilot.errors[other] = 0.09;
    const auto takes_other = [&] { return choose(pilot) != usual; };
    CHECK(takes_other());
    // The gain is 0.01, the standard error of either prediction 0.006, that of the difference is
    // smaller where they are correlated.
    constexpr double variance = 0.006 * 0.006;
    pilot.covariances[usual][usual] = variance;
    pilot.covariances[other][other] = variance;
    CHECK_FALSE(takes_other());
    pilot.covariances[usual][other] = 0.7 * variance;
    pilot.covariances[other][usual] = 0.7 * variance;
    CHECK(takes_other());
    // Costs multiply both: that of the other candidate alone makes the difference less certain.
    pilot.errors[other] = 0.03;
    pilot.covariances[usual][other] = variance;
    pilot.covariances[other][usual] = variance;
    CHECK(takes_other());
    pilot.costs[other] *= 3.0;
    CHECK_FALSE(takes_other());
    // Others need no sure gain.
    pilot.errors[index_of(0.25, 0.25)] = 0.099;
    CHECK(chosen_by(pilot) == Candidate{0.25, 0.25});
}

TEST_CASE("light paths without connections are chosen where they are clearly better", "[pilot]")
{
    struct Case {
        double light_paths;
        double not_enough;  // error where one with connections has 0.1
        double better;
    };
    // Up to one light path has to be better by 5 %; more by the noise of the prediction.
    const auto [light_paths, not_enough, better] = GENERATE(values<Case>(
        {{0.0625, 0.098, 0.09}, {0.5, 0.098, 0.09}, {2.0, 0.101, 0.099}, {4.0, 0.101, 0.099}}));
    PilotMeasurements pilot = equal_candidates();
    pilot.errors[index_of(0.0625, 1.0)] = 0.1;
    pilot.errors[index_of(light_paths, 0.0)] = not_enough;
    CHECK(chosen_by(pilot) == Candidate{0.0625, 1.0});
    pilot.errors[index_of(light_paths, 0.0)] = better;
    CHECK(chosen_by(pilot) == Candidate{light_paths, 0.0});
}

TEST_CASE("more than one light path is a candidate without connections alone", "[pilot]")
{
    for (const Candidate& candidate : candidates) {
        CHECK((candidate.light_paths <= 1.0 || candidate.connections == 0.0));
    }
}

TEST_CASE("rare bright paths that a pilot is sure of count a little", "[pilot]")
{
    PilotMeasurements pilot = equal_candidates();
    pilot.errors[0] = 0.15;
    pilot.errors[index_of(0.0625, 1.0)] = 0.2;
    const auto light_paths = [&] { return chosen_by(pilot).light_paths; };
    CHECK(light_paths() == 0.0);
    pilot.fireflies[0] = 0.1;  // errors of 1.67 times that count 1.29 times
    CHECK(light_paths() == 0.0);
    pilot.fireflies[0] = 0.15;  // 1.41 times
    CHECK(light_paths() > 0.0);
    pilot.fireflies[index_of(0.0625, 1.0)] = 0.4;
    CHECK(light_paths() == 0.0);
}

TEST_CASE("path tracing has to hit lamps, to whose points bdpt connects the lens", "[pilot]")
{
    PilotMeasurements pilot;
    pilot.errors.fill(1.0);
    pilot.costs.fill(10000.0);
    pilot.errors[index_of(0.0625, 1.0)] = 0.2;
    pilot.errors[0] = 0.15;
    const auto light_paths = [&] { return chosen_by(pilot).light_paths; };
    CHECK(light_paths() == 0.0);
    pilot.visible_lights = {.by_hits = 0.04, .by_both = 0.01};
    CHECK(light_paths() == 0.0);
    pilot.visible_lights = {.by_hits = 0.07, .by_both = 0.01};
    CHECK(light_paths() > 0.0);
}

TEST_CASE("light that camera paths find at once needs no light paths, a caustic does", "[pilot]")
{
    PilotMeasurements pilot = equal_candidates();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        pilot.costs[k] =
            300.0 + 500.0 * candidates[k].light_paths + 200.0 * candidates[k].connections;
    }
    CHECK(chosen_by(pilot) == Candidate{0.0, 0.0});
    pilot.errors[0] = 50.0;  // rays hit the lamp by chance
    for (std::size_t k = 1; k < candidates.size(); ++k) {
        pilot.errors[k] = 1.0 / candidates[k].light_paths;
    }
    CHECK(chosen_by(pilot).light_paths >= 1.0);
}

TEST_CASE("an image without error is rendered at the least cost", "[pilot]")
{
    PilotMeasurements pilot = equal_candidates();
    pilot.errors.fill(1e-7);
    pilot.errors[index_of(0.25, 0.25)] = 1e-9;
    pilot.costs[0] = 9.0;
    CHECK(chosen_by(pilot) == Candidate{0.0, 0.0});
    ChoiceConstants exact;
    exact.min_error = 0.0;
    CHECK(candidates[choose(pilot, candidates, exact)] == Candidate{0.25, 0.25});
}

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
    PilotMeasurements pilot;
    pilot.cells = equal_cells();
    multiply_right(pilot.cells.camera, 30.0);
    pilot.grid = grid();
    CHECK(choose_rates(pilot, used) != nullptr);
    pilot.light_is_rare = true;
    CHECK(choose_rates(pilot, used) == nullptr);
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

TEST_CASE("rates help little where fireflies are the noise", "[pilot]")
{
    CellErrors cells = equal_cells();
    multiply_right(cells.camera, 30.0);
    cells.fireflies[used] = 100.0;
    CHECK(rates_of(cells) == nullptr);
}

TEST_CASE("fireflies are the noise of cells where paths scatter", "[pilot]")
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
        cells.fireflies[used] = 100.0;
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

}  // namespace bdpt::test::choice_test
