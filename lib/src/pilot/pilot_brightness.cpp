#include "pilot/pilot_brightness.h"

#include <algorithm>

namespace bdpt {
namespace {

constexpr int reach = 1;  // on every side [cells]
constexpr int around = (2 * reach + 1) * (2 * reach + 1);

/// Returns the means over the cells around each; beyond the edge of the image the last row or
/// column is repeated.
std::vector<double> averaged(const PilotGrid& grid, const std::vector<double>& values)
{
    std::vector<double> result;
    result.reserve(values.size());
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            double sum = 0.0;
            for (int i = 0; i < around; ++i) {
                const int x =
                    std::clamp(column + i % (2 * reach + 1) - reach, 0, grid.columns() - 1);
                const int y = std::clamp(row + i / (2 * reach + 1) - reach, 0, grid.rows() - 1);
                sum += values[grid.index(x, y)];
            }
            result.push_back(sum / around);
        }
    }
    return result;
}

}  // namespace

PilotBrightness::PilotBrightness(const PilotContributions& contributions)
    : share_of_splat_(static_cast<double>(contributions.grid.cells()) /
                      (contributions.splatted_pixels() * around))
{
    const PilotGrid& grid = contributions.grid;
    std::vector<double> camera;
    camera.reserve(grid.cells());
    std::vector<double> splats(grid.cells());
    for (const PilotRow& row : contributions.rows) {
        for (const PilotCell& cell : row.cells()) {
            camera.push_back(cell.mean);
        }
        for (const PilotLamp& lamp : row.lamps()) {
            splats[lamp.cell] += lamp.mean / PilotRow::samples_of_cell;
        }
    }
    for (const PilotSplats& part : contributions.parts) {
        for (const PilotContribution& splat : part.contributions()) {
            splats[splat.cell] += splat.shares.splat_mean() * share_of_splat_ * around;
        }
    }
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        average_ += (camera[i] + splats[i]) / static_cast<double>(grid.cells());
    }
    camera_ = averaged(grid, camera);
    splats_ = averaged(grid, splats);
}

double PilotBrightness::compute_scale(std::size_t cell, double less) const
{
    constexpr double epsilon = 0.01;  // relative to the mean's square, as in the test harness
    const double mean = camera_[cell] + std::max(0.0, splats_[cell] - less);
    const double square = mean * mean + epsilon * average_ * average_;
    return square > 0.0 ? 1.0 / square : 0.0;
}

}  // namespace bdpt
