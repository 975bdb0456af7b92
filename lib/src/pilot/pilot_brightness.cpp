#include "pilot/pilot_brightness.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace bdpt {
namespace {

/// Light is rare if more than this fraction of the lit cells has its brightness from fewer than
/// `fewest_paths` paths. In usual scenes less than a twentieth has.
constexpr double rare_fraction = 0.25;
/// Square of the brightness over its variance: N paths of equal light, found by chance, have N.
constexpr double fewest_paths = 1.5;

/// Returns the index of a row or column, or of its mirror image beyond the edge.
int mirrored(int index, int size)
{
    const int period = 2 * size;
    const int within = (index % period + period) % period;
    return within < size ? within : period - 1 - within;
}

/// Returns the means of `reach` cells on either side of each, and of itself. `neighbour` returns
/// the index of the cell that is `i` cells from a column and row.
template <typename Neighbour>
std::vector<double> averaged_along(const PilotGrid& grid, const std::vector<double>& values,
                                   int reach, const Neighbour& neighbour)
{
    std::vector<double> result;
    result.reserve(values.size());
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            double sum = 0.0;
            for (int i = -reach; i <= reach; ++i) {
                sum += values[neighbour(column, row, i)];
            }
            result.push_back(sum / (2 * reach + 1));
        }
    }
    return result;
}

/// Returns the means over squares around each cell, which extend over `reach` cells on every side.
std::vector<double> averaged(const PilotGrid& grid, const std::vector<double>& values, int reach)
{
    const std::vector<double> along_rows =
        averaged_along(grid, values, reach, [&](int column, int row, int i) {
            return grid.index(mirrored(column + i, grid.columns()), row);
        });
    return averaged_along(grid, along_rows, reach, [&](int column, int row, int i) {
        return grid.index(column, mirrored(row + i, grid.rows()));
    });
}

/// Brightness by camera paths and by splats, and the variance of the sum of both.
struct CellBrightness {
    std::vector<double> camera;
    std::vector<double> splats;
    std::vector<double> variances;

    /// Returns means over squares around each cell, and the variances of these means.
    [[nodiscard]] CellBrightness around(const PilotGrid& grid, int reach) const
    {
        CellBrightness result{.camera = averaged(grid, camera, reach),
                              .splats = averaged(grid, splats, reach),
                              .variances = averaged(grid, variances, reach)};
        const int side = 2 * reach + 1;
        for (double& variance : result.variances) {
            variance /= side * side;
        }
        return result;
    }
    [[nodiscard]] bool light_is_rare() const
    {
        double lit = 0.0;
        double by_few = 0.0;
        for (std::size_t i = 0; i < camera.size(); ++i) {
            const double mean = camera[i] + splats[i];
            lit += mean > 0.0 ? 1.0 : 0.0;
            by_few += mean * mean < fewest_paths * variances[i] ? 1.0 : 0.0;
        }
        return by_few > rare_fraction * lit;
    }
};

}  // namespace

PilotBrightness::PilotBrightness(const PilotContributions& contributions)
{
    const PilotGrid& grid = contributions.grid;
    const double share_of_splat =
        static_cast<double>(grid.cells()) / contributions.splatted_pixels();
    CellBrightness cells{
        .camera = {}, .splats = std::vector<double>(grid.cells()), .variances = {}};
    for (const PilotRow& row : contributions.rows) {
        for (const PilotCell& cell : row.cells()) {
            cells.camera.push_back(cell.mean());
            cells.variances.push_back(cell.variance());
        }
        for (const PilotLamp& lamp : row.lamps()) {
            cells.splats[lamp.cell] += lamp.mean / PilotRow::samples_of_cell;
        }
    }
    for (const PilotSplats& part : contributions.parts) {
        for (const PilotContribution& splat : part.contributions()) {
            const double value = splat.shares.splat_mean() * share_of_splat;
            cells.splats[splat.cell] += value;
            cells.variances[splat.cell] += value * value;
        }
    }
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        average_ += (cells.camera[i] + cells.splats[i]) / static_cast<double>(grid.cells());
    }
    int reach = 1;
    CellBrightness around = cells.around(grid, reach);
    light_is_rare_ = around.light_is_rare();
    for (bool rare = light_is_rare_; rare && 2 * reach + 1 < std::max(grid.columns(), grid.rows());
         rare = around.light_is_rare()) {
        reach *= 2;
        around = cells.around(grid, reach);
    }
    camera_ = std::move(around.camera);
    splats_ = std::move(around.splats);
    share_of_splat_ = share_of_splat / ((2 * reach + 1) * (2 * reach + 1));
}

double PilotBrightness::compute_scale(std::size_t cell, double less) const
{
    constexpr double epsilon = 0.01;  // relative to the mean's square, as in the test harness
    const double mean = camera_[cell] + std::max(0.0, splats_[cell] - less);
    const double square = mean * mean + epsilon * average_ * average_;
    return square > 0.0 ? 1.0 / square : 0.0;
}

}  // namespace bdpt
