#pragma once

#include "verify/measure.h"
#include "verify/roulette.h"
#include "verify/second_moment.h"

#include <bdpt/path_contribution.h>

#include <cstddef>
#include <vector>

namespace bdpt::eval {

/// What the paths of vcm of one length say about merging, as `StrategySums` about a strategy: g =
/// min(1, share / `full_share`) with the share that all merges of a path have together. Sums over
/// samples of a measure [nit].
struct MergeSumsOfLength {
    double brought = 0.0;        ///< weighted paths that were merged
    double tested = 0.0;         ///< g times merged paths, weighed among merges alone
    double expected = 0.0;       ///< g times the weighted paths that anyone found
    double by_merges = 0.0;      ///< the part of `expected` that was merged
    SecondMoment second_moment;  ///< of a sample of `tested`, estimated from all paths
    SecondMoment seen;

    MergeSumsOfLength& operator+=(const MergeSumsOfLength& other);
};

/// Sums over the paths that vcm found in some samples, weighed by the balance heuristic. Not for
/// several threads at once.
class MergeSums {
public:
    MergeSums(int max_depth, Measure measure)
        : measure_(measure), roulette_(max_depth), lengths_(static_cast<std::size_t>(max_depth))
    {}

    /// Those with more edges and values that are not finite are ignored. Knows its shares.
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
