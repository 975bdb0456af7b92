#include "pilot/pilot_rates.h"

#include "rates/rate_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace bdpt {
namespace {

// Few samples in a pixel make rare bright paths brighter still, and what two samples in each cell
// say is too uncertain for large rates.
constexpr int min_exponent = -1;
constexpr int max_exponent = 1;
/// Cells are averaged with their neighbours, as each has two samples; and rare bright paths that
/// are missed in one neighbourhood may be found in the next, so the maximum of nearby ones counts.
constexpr int mean_radius = 3;  // 7 x 7 cells
constexpr int max_radius = 1;   // 3 x 3 cells
/// Error beside the pilot's estimate and dots, as a fraction of the mean error: rare bright paths
/// also occur where the pilot has not found them.
constexpr double unseen_share = 0.25;
/// Cells where no camera path scatters have this share of both, relative to other cells: light that
/// is seen directly has little noise, which the pilot does not measure.
constexpr double share_of_background = 0.05;
/// Fraction of the cells with the greatest errors, all of which count like the least of them.
constexpr double share_of_dots = 0.001;
/// Rates are worth it if they reduce error times cost to this or less.
constexpr double worthwhile = 0.94;

/// Limits the errors of the brightest cells.
void clamp_dots(Plane& errors)
{
    const auto dots = static_cast<std::size_t>(share_of_dots * static_cast<double>(errors.size()));
    Plane sorted = errors;
    const auto limit = sorted.end() - 1 - static_cast<std::ptrdiff_t>(dots);
    std::nth_element(sorted.begin(), limit, sorted.end());
    for (double& error : errors) {
        error = std::min(error, *limit);
    }
}

/// Errors and costs of the cells for one candidate, averaged over neighbours.
struct Evidence {
    Plane errors;
    Plane costs;
    double splats;
};

Evidence evidence_for(std::size_t candidate, const PilotGrid& grid, const CellErrors& cells)
{
    const PlaneSize size{.width = grid.columns(), .height = grid.rows()};
    Plane errors;
    Plane costs;
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        errors.push_back(cells.camera[i][candidate]);
        costs.push_back(cells.costs[i][candidate]);
    }
    clamp_dots(errors);
    const double unseen = unseen_share * std::max(0.0, mean_of(errors)) + cells.dots[candidate];
    errors = local_mean(errors, size, mean_radius);
    Plane shares = local_mean(cells.scattering, size, mean_radius);
    for (double& share : shares) {
        share = std::max(share, share_of_background);
    }
    const double mean_share = mean_of(shares);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = std::max(0.0, errors[i]) + unseen * shares[i] / mean_share;
    }
    return {.errors = std::move(errors),
            .costs = local_mean(costs, size, mean_radius),
            .splats = cells.splats[candidate]};
}

/// Returns the number of pixels of each cell, from the cells of all columns and rows of pixels.
std::vector<std::int64_t> count_pixels(const PilotGrid& grid, const std::vector<int>& columns,
                                       const std::vector<int>& rows)
{
    std::vector<std::int64_t> widths(static_cast<std::size_t>(grid.columns()));
    for (const int column : columns) {
        ++widths[static_cast<std::size_t>(column)];
    }
    std::vector<std::int64_t> pixels(grid.cells());
    for (const int row : rows) {
        for (int column = 0; column < grid.columns(); ++column) {
            pixels[grid.index(column, row)] += widths[static_cast<std::size_t>(column)];
        }
    }
    return pixels;
}

/// Returns error times cost with the exponents over that without.
double product_of(const Evidence& evidence, const std::vector<std::int8_t>& exponents,
                  const std::vector<std::int64_t>& pixels)
{
    double error = 0.0;
    double error_of_equal = 0.0;
    double cost = 0.0;
    double cost_of_equal = 0.0;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        const auto rate = static_cast<double>(SampleRates::to_rate(exponents[i]));
        const auto n = static_cast<double>(pixels[i]);
        error += n * (evidence.errors[i] / rate + evidence.splats);
        error_of_equal += n * (evidence.errors[i] + evidence.splats);
        cost += n * evidence.costs[i] * rate;
        cost_of_equal += n * evidence.costs[i];
    }
    return error / error_of_equal * (cost / cost_of_equal);
}

}  // namespace

std::shared_ptr<const SampleRates> choose_rates(const PilotGrid& grid, const CellErrors& cells,
                                                std::size_t candidate)
{
    const Evidence evidence = evidence_for(candidate, grid, cells);
    Plane wanted = local_greatest(evidence.errors, {.width = grid.columns(), .height = grid.rows()},
                                  max_radius);
    const double mean = mean_of(wanted);
    if (!(mean > 0.0) || !std::isfinite(mean)) {
        return nullptr;  // no noise, or noise that the candidate cannot reduce
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i] = std::sqrt(wanted[i] / evidence.costs[i]);
    }
    const std::vector<int> columns = grid.columns_of_pixels();
    const std::vector<int> rows = grid.rows_of_pixels();
    const std::vector<std::int64_t> pixels = count_pixels(grid, columns, rows);
    const std::vector<std::int8_t> exponents =
        fitting_exponents(wanted, pixels, {.min = min_exponent, .max = max_exponent});
    if (product_of(evidence, exponents, pixels) > worthwhile) {
        return nullptr;
    }
    std::vector<std::int8_t> of_pixels;
    of_pixels.reserve(rows.size() * columns.size());
    for (const int row : rows) {
        for (const int column : columns) {
            of_pixels.push_back(exponents[grid.index(column, row)]);
        }
    }
    return std::make_shared<const SampleRates>(grid.width(), grid.height(), std::move(of_pixels));
}

}  // namespace bdpt
