#pragma once

#include "verify/measure.h"
#include "verify/roulette.h"
#include "verify/second_moment.h"

#include <bdpt/path_contribution.h>

#include <cstddef>
#include <vector>

namespace bdpt::eval {

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
