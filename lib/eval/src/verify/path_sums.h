#pragma once

#include <bdpt/eval/verify.h>
#include <bdpt/path_contribution.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "verify/samples.h"

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

/// Layout of the strategies of paths of 1 to `max_depth` edges in an array: by length, then by s.
class StrategyRow {
public:
    explicit StrategyRow(int max_depth) : max_depth_(max_depth) {}

    [[nodiscard]] int max_depth() const { return max_depth_; }
    [[nodiscard]] std::size_t size() const { return begin(max_depth_ + 1); }
    /// Returns the index of the first strategy of paths of `edges` edges.
    [[nodiscard]] std::size_t begin(int edges) const
    {
        return static_cast<std::size_t>(edges * (edges + 3) / 2 - 2);
    }
    [[nodiscard]] std::size_t index(Strategy strategy) const
    {
        return begin(strategy.s + strategy.t - 1) + static_cast<std::size_t>(strategy.s);
    }

    /// Returns the number of pairs of strategies of the same length, which have an array layout,
    /// too.
    [[nodiscard]] std::size_t pairs() const { return pair(max_depth_ + 1, 0, 0); }
    [[nodiscard]] std::size_t pair(int edges, std::size_t u, std::size_t v) const
    {
        std::size_t first = 0;
        for (int shorter = 1; shorter < edges; ++shorter) {
            first += square(shorter + 2);
        }
        return first + u * static_cast<std::size_t>(edges + 2) + v;
    }

private:
    [[nodiscard]] static std::size_t square(int x) { return static_cast<std::size_t>(x * x); }

    int max_depth_;
};

/// Balance-heuristic share of a strategy below which its samples are scaled down in the test of the
/// strategy. So each counts at most 1 / `full_share` times the estimate of all strategies together
/// for the path.
constexpr double full_share = 1.0 / 16.0;

/// Sums over the paths of bdpt that test one strategy u in one tile, all of the compared measure
/// [nit]. The test covers paths in which u has a share, each multiplied by g = min(1, share /
/// `full_share`); g is a function of the path, so it does not depend on the strategy that found it.
/// Expected second moments hold for the greatest weight that roulette may give.
struct StrategySums {
    double tested = 0.0;    ///< g times the unweighted paths that u found
    double expected = 0.0;  ///< g times the weighted paths of all strategies
    /// Moment of a sample's `tested - expected`, estimated from all paths.
    SecondMoment second_moment;
    SecondMoment seen;      ///< moment of a sample's `tested - expected`, from the paths as found
    double reach = 0.0;     ///< weighted paths that u can sample, found by any strategy
    double weighted = 0.0;  ///< paths that u found
    double unweighted = 0.0;
    double solitary = 0.0;   ///< weighted paths that u alone can sample
    double unchecked = 0.0;  ///< part of `solitary` that no integrator samples from the camera

    StrategySums& operator+=(const StrategySums& other);
};

/// Weighted paths that an integrator can sample, and the second moment of a sample of them.
struct ReachSums {
    double radiance = 0.0;
    SecondMoment second_moment;  ///< estimated from all paths
    SecondMoment seen;
    ReachSums& operator+=(const ReachSums& other);
};

/// Sums over the paths of bdpt of one length that test the other integrators in one tile.
struct LengthSums {
    ReachSums all;          ///< vcm can sample them
    ReachSums from_camera;  ///< pt, nee and mis can sample them
    ReachSums from_light;   ///< lt can sample them
    /// Second moment of a sample of each integrator itself, estimated from the paths of bdpt.
    SecondMoment pt;
    SecondMoment nee;
    SecondMoment mis;
    SecondMoment lt;

    LengthSums& operator+=(const LengthSums& other);
};

/// Numbers of samples that strategies of bdpt take per camera path.
struct SampleCounts {
    double light_paths = 1.0;
    int light_samples = 1;  ///< at each vertex of the camera path
};

/// Sums over the paths that bdpt found in some samples. Not thread-safe.
class PathSums {
public:
    PathSums(const TileGrid& grid, int max_depth, SampleCounts counts = {},
             Measure measure = Measure::mean);

    /// Adds a path, which has its shares and is weighted by the power heuristic. Paths with more
    /// than `max_depth` edges and values that are not finite are ignored.
    void add(const PathContribution& path);

    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] const StrategySums& strategy(std::size_t tile, std::size_t index) const
    {
        return strategies_[tile * row_.size() + index];
    }
    [[nodiscard]] const LengthSums& length(std::size_t tile, int edges) const
    {
        return lengths_[tile * static_cast<std::size_t>(row_.max_depth()) +
                        static_cast<std::size_t>(edges - 1)];
    }
    /// Returns, for the whole image and paths of `edges` edges, the part of the estimate `expected`
    /// of the strategy with `u` light vertices that comes from paths found by the strategy with
    /// `finder` light vertices.
    [[nodiscard]] double expected_from(int edges, std::size_t u, std::size_t finder) const
    {
        return finders_[row_.pair(edges, u, finder)];
    }
    [[nodiscard]] const WeightFinding& weights() const { return weights_; }

private:
    void check_weight(const PathContribution& path, double definition);
    /// Values of a path for any strategy, by the balance and the power heuristic.
    struct PathValue {
        double weighted;  // MIS-weighted value, as found
        double all;       // value by the balance heuristic, whichever strategy found it
        double squares;   // sum of squared shares
        double moment;    // upper bound of the second moment of a sample of bdpt along this path
        double largest;   // greatest such sample
    };
    void add_to_strategies(const PathContribution& path, const PathValue& measure,
                           std::size_t first);
    void add_to_length(LengthSums& sums, const PathContribution& path,
                       const PathValue& measure) const;
    /// Returns the greatest roulette weight of a path of `edges` edges that the strategy with `s`
    /// light vertices finds. The light samples of one vertex are correlated, so they count as one
    /// sample as great as all of them.
    [[nodiscard]] double max_weight(int edges, std::size_t s) const
    {
        const auto light = static_cast<int>(s);
        const int together = s == 1 && edges > 1 ? counts_.light_samples : 1;
        return together * roulette_.max_weight({.s = light, .t = edges + 1 - light});
    }

    TileGrid grid_;
    StrategyRow row_;
    SampleCounts counts_;
    Measure measure_;
    Roulette roulette_;
    std::vector<StrategySums> strategies_;  // by tile, then by index
    std::vector<LengthSums> lengths_;       // by tile, then by length
    std::vector<double> finders_;           // by length, tested strategy, finder
    WeightFinding weights_;
};

/// Sums over the paths of vcm of one length that test merging, as `StrategySums` test a strategy: g
/// = min(1, share / `full_share`) with the total share of all merges of a path. Sums over samples
/// of a measure [nit].
struct MergeSumsOfLength {
    double brought = 0.0;    ///< weighted merged paths
    double tested = 0.0;     ///< g times merged paths, weighted among merges alone
    double expected = 0.0;   ///< g times the weighted paths of all techniques
    double by_merges = 0.0;  ///< part of `expected` that was merged
    /// Second moment of a sample of `tested`, estimated from all paths.
    SecondMoment second_moment;
    SecondMoment seen;

    MergeSumsOfLength& operator+=(const MergeSumsOfLength& other);
};

/// Sums over the paths that vcm found in some samples, weighted by the balance heuristic. Not
/// thread-safe.
class MergeSums {
public:
    MergeSums(int max_depth, Measure measure)
        : measure_(measure), roulette_(max_depth), lengths_(static_cast<std::size_t>(max_depth))
    {}

    /// Adds a path, which has its shares. Paths with more than `max_depth` edges and values that
    /// are not finite are ignored.
    void add(const PathContribution& path);

    [[nodiscard]] const MergeSumsOfLength& length(int edges) const
    {
        return lengths_[static_cast<std::size_t>(edges - 1)];
    }

private:
    Measure measure_;
    Roulette roulette_;
    std::vector<MergeSumsOfLength> lengths_;
};

}  // namespace bdpt::eval
