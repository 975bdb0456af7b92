#pragma once

#include "verify/tile_grid.h"

#include <bdpt/found_path.h>
#include <bdpt/harness/verify/verify_report.h>

#include <cstddef>
#include <vector>

namespace bdpt::harness {

/// Where strategies of paths of 1 to `max_depth` edges stand in a row: by length, then by s.
class StrategyRow {
public:
    explicit StrategyRow(int max_depth) : max_depth_(max_depth) {}

    [[nodiscard]] int max_depth() const { return max_depth_; }
    [[nodiscard]] std::size_t size() const { return begin(max_depth_ + 1); }
    /// The first of paths of `edges` edges.
    [[nodiscard]] std::size_t begin(int edges) const
    {
        return static_cast<std::size_t>(edges * (edges + 3) / 2 - 2);
    }
    [[nodiscard]] std::size_t index(Strategy strategy) const
    {
        return begin(strategy.s + strategy.t - 1) + static_cast<std::size_t>(strategy.s);
    }

private:
    int max_depth_;
};

/// The share of a strategy by the balance heuristic below which its samples count less in the test
/// of the strategy: so each counts at most for the inverse of it times what all strategies together
/// would make of the path.
constexpr double full_share = 1.0 / 16.0;

/// What the paths of bdpt say about one strategy u in one tile. All numbers are sums of mean
/// channels [nit]. Tested are the paths in which u has a share, each multiplied by g = min(1, share
/// / `full_share`); g is a function of the path, so whoever finds it takes the same.
struct StrategySums {
    double tested = 0.0;              ///< g times the unweighted paths that u found
    double expected = 0.0;            ///< g times the weighted paths that anyone found
    double expected_by_others = 0.0;  ///< of these, those that u did not find
    double second_moment = 0.0;  ///< of a sample's `tested - expected`, estimated from all paths
    double reach = 0.0;          ///< weighted paths that u can make, found by anyone
    double weighted = 0.0;       ///< paths that u found
    double unweighted = 0.0;
    double solitary = 0.0;   ///< weighted paths that u alone can make
    double unchecked = 0.0;  ///< of these, those that no integrator makes from the camera

    StrategySums& operator+=(const StrategySums& other);
};

/// Weighted paths that an integrator can make, and the second moment of a sample of them.
struct ReachSums {
    double radiance = 0.0;
    double second_moment = 0.0;
    ReachSums& operator+=(const ReachSums& other);
};

/// What the paths of bdpt of one length say about the other integrators in one tile.
struct LengthSums {
    double radiance = 0.0;
    ReachSums from_camera;  ///< pt, nee and mis can make them
    ReachSums from_light;   ///< lt can make them
    /// Of a sample of the integrators themselves, estimated from the paths of bdpt.
    double second_moment_pt = 0.0;
    double second_moment_nee = 0.0;
    double second_moment_mis = 0.0;
    double second_moment_lt = 0.0;

    LengthSums& operator+=(const LengthSums& other);
};

/// Sums over the paths that bdpt found in some samples. Not for several threads at once.
class PathSums {
public:
    PathSums(const TileGrid& grid, int max_depth);

    /// Those with more than `max_depth` edges or values that are not finite are ignored. Knows its
    /// shares; weighed by the power heuristic.
    void add(const FoundPath& path);

    [[nodiscard]] const StrategySums& strategy(std::size_t tile, std::size_t index) const
    {
        return strategies_[tile * row_.size() + index];
    }
    [[nodiscard]] const LengthSums& length(std::size_t tile, int edges) const
    {
        return lengths_[tile * static_cast<std::size_t>(row_.max_depth()) +
                        static_cast<std::size_t>(edges - 1)];
    }
    [[nodiscard]] const WeightFinding& weights() const { return weights_; }

private:
    void check_weight(const FoundPath& path, double definition);
    void add_to_length(LengthSums& sums, const FoundPath& path, double weighted, double all,
                       double variance) const;

    const TileGrid& grid_;
    StrategyRow row_;
    std::vector<StrategySums> strategies_;  // by tile, then by index
    std::vector<LengthSums> lengths_;       // by tile, then by length
    WeightFinding weights_;
};

}  // namespace bdpt::harness
