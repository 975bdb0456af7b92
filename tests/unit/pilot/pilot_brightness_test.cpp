#include "pilot/pilot_contributions.h"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace bdpt::test::pilot_brightness_test {
namespace {

constexpr int side = 5;  // of so few pixels each has a cell
constexpr int middle = 2;
constexpr float radiance = 9.0f;
constexpr double average = 9.0 / (side * side);
constexpr double floor_of_squares = 0.01 * average * average;

/// Finds light in the middle of the image alone, along one path a sample.
class Lamp final : public Integrator {
public:
    explicit Lamp(Strategy strategy) : strategy_(strategy)
    {
        shares_[static_cast<std::size_t>(strategy.s)] = 1.0f;
    }
    RenderStats render_chunk(std::int64_t /*part*/, SampleRange /*samples*/,
                             const Films& films) override
    {
        if (strategy_.t <= 1) {
            report(films);
        }
        return {};
    }
    RenderStats render_tile(const Tile& tile, SampleRange /*samples*/,
                            const Films& films) const override
    {
        if (strategy_.t > 1 && tile.x_begin == middle && tile.y_begin == middle) {
            report(films);
        }
        return {};
    }

private:
    void report(const Films& films) const
    {
        films.on_path({.strategy = strategy_,
                       .merged = false,
                       .light_path = 0,
                       .raster = Vec2(middle + 0.5f),
                       .unweighted = Rgb(radiance),
                       .weight = 1.0f,
                       .shares = shares_});
    }

    Strategy strategy_;
    std::array<float, 5> shares_{};
};

PilotContributions contributions_of(Integrator&& lights, PilotGrid grid = {side, side})
{
    PilotContributions contributions{
        .grid = grid,
        .light_paths = 1.0,
        .rows = std::vector<PilotRow>(static_cast<std::size_t>(grid.rows())),
        .parts = std::vector<PilotSplats>(1)};
    for (int index = 0; index < PilotRow::samples_of_cell; ++index) {
        contributions.parts[0].trace(lights, 0, index, grid, Heuristic::power,
                                     contributions.light_paths);
        for (int row = 0; row < grid.rows(); ++row) {
            contributions.rows[static_cast<std::size_t>(row)].render(
                lights, grid, Heuristic::power, row, index, contributions.light_paths);
        }
    }
    return contributions;
}

/// Camera paths find the same light in all cells, in both samples; or, in one of 25 cells, 25 times
/// as much in both, or 50 times as much in one of them.
class RareLight final : public Integrator {
public:
    enum class Found { everywhere, in_few_cells, in_few_samples };
    explicit RareLight(Found found) : found_(found) {}

    RenderStats render_tile(const Tile& tile, SampleRange samples,
                            const Films& films) const override
    {
        const bool here = tile.x_begin % 5 == 0 && tile.y_begin % 5 == 0;
        const float value = found_ == Found::everywhere     ? radiance
                            : !here                         ? 0.0f
                            : found_ == Found::in_few_cells ? 25.0f * radiance
                            : samples.begin == 0            ? 50.0f * radiance
                                                            : 0.0f;
        if (value > 0.0f) {
            films.on_path({.strategy = {.s = 1, .t = 3},
                           .merged = false,
                           .light_path = 0,
                           .raster = Vec2(0.5f),
                           .unweighted = Rgb(value),
                           .weight = 1.0f,
                           .shares = shares_});
        }
        return {};
    }

private:
    Found found_;
    std::array<float, 5> shares_{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
};

}  // namespace

TEST_CASE("errors of a pilot are relative to the brightness of the cells around", "[pilot]")
{
    for (const Strategy strategy : {Strategy{.s = 1, .t = 3}, Strategy{.s = 3, .t = 1}}) {
        CAPTURE(strategy.s);
        const PilotContributions contributions = contributions_of(Lamp(strategy));
        const PilotBrightness brightness(contributions);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const bool near = std::abs(x - middle) <= 1 && std::abs(y - middle) <= 1;
                const double mean = near ? 1.0 : 0.0;
                CHECK(brightness.scale(contributions.grid.index(x, y)) ==
                      Approx(1.0 / (mean * mean + floor_of_squares)));
            }
        }
    }
}

TEST_CASE("a splat does not count for its own place", "[pilot]")
{
    const PilotContributions contributions = contributions_of(Lamp({.s = 3, .t = 1}));
    const PilotBrightness brightness(contributions);
    const auto& splats = contributions.parts[0].contributions();
    REQUIRE(splats.size() == PilotRow::samples_of_cell);
    const double others = 1.0 - 1.0 / PilotRow::samples_of_cell;
    CHECK(brightness.scale(splats.front()) == Approx(1.0 / (others * others + floor_of_squares)));
}

TEST_CASE("brightness that few paths know is averaged over more cells", "[pilot]")
{
    using Found = RareLight::Found;
    const auto found = GENERATE(Found::everywhere, Found::in_few_cells, Found::in_few_samples);
    CAPTURE(static_cast<int>(found));
    const PilotContributions contributions = contributions_of(RareLight(found), {25, 20});
    REQUIRE(contributions.grid.cells() == 500);  // one for each of so few pixels
    const PilotBrightness brightness(contributions);
    CHECK(brightness.average() == Approx(static_cast<double>(radiance)));
    CHECK(brightness.light_is_rare() == (found == Found::in_few_samples));
    const auto mean_at = [&](int column, int row) {
        return 1.0 / std::sqrt(brightness.scale(contributions.grid.index(column, row)));
    };
    constexpr int lit =
        10;  // column and row of a lit cell; the cell two columns and rows on is dark
    if (found == Found::in_few_cells) {
        CHECK(mean_at(lit, lit) > 10.0 * mean_at(lit + 2, lit + 2));
    } else {
        CHECK(mean_at(lit, lit) < 2.0 * mean_at(lit + 2, lit + 2));
    }
}

}  // namespace bdpt::test::pilot_brightness_test
