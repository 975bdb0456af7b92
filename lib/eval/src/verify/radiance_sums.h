#pragma once

#include "verify/measure.h"
#include "verify/second_moment.h"
#include "verify/tile_grid.h"

#include <bdpt/path_contribution.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::eval {

/// Sums of a measure over the weighted paths that an integrator found in some samples, by tile and
/// length [nit]. Not thread-safe.
class RadianceSums {
public:
    RadianceSums(const TileGrid& grid, int max_depth, Measure measure = Measure::mean)
        : grid_(grid),
          max_depth_(max_depth),
          measure_(measure),
          sums_(grid.size() * static_cast<std::size_t>(max_depth)),
          seen_(sums_.size())
    {}

    /// Adds a path. Paths with more than `max_depth` edges and values that are not finite are
    /// ignored.
    void add(const PathContribution& path)
    {
        const int edges = count_edges(path);
        const double value = static_cast<double>(path.weight) * measured(measure_, path.unweighted);
        if (edges <= max_depth_ && std::isfinite(value)) {
            const std::size_t place = index(grid_.tile_at(path.raster), edges);
            sums_[place] += value;
            seen_[place].add(value, value * value);
        }
    }

    [[nodiscard]] double at(std::size_t tile, int edges) const { return sums_[index(tile, edges)]; }
    /// Returns the second moment of single paths.
    [[nodiscard]] const SecondMoment& seen(std::size_t tile, int edges) const
    {
        return seen_[index(tile, edges)];
    }
    /// Returns the sum over lengths from `shortest` to `longest`.
    [[nodiscard]] double between(std::size_t tile, int shortest, int longest) const
    {
        double sum = 0.0;
        for (int edges = shortest; edges <= longest; ++edges) {
            sum += at(tile, edges);
        }
        return sum;
    }

private:
    [[nodiscard]] std::size_t index(std::size_t tile, int edges) const
    {
        return tile * static_cast<std::size_t>(max_depth_) + static_cast<std::size_t>(edges - 1);
    }

    TileGrid grid_;
    int max_depth_;
    Measure measure_;
    std::vector<double> sums_;
    std::vector<SecondMoment> seen_;
};

}  // namespace bdpt::eval
