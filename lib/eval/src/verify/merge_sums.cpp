#include "verify/merge_sums.h"

#include "verify/path_sums.h"

#include <algorithm>
#include <cmath>

namespace bdpt::eval {
namespace {

/// Returns the share of all merges of the path. Sums of floats are off by some 1e-7: shares below
/// 1e-4 count as 0, whichever technique found the path.
double share_of_merges(const PathContribution& path)
{
    constexpr double min_share = 1e-4;
    double joins = 0.0;
    for (const float share : path.shares) {
        joins += static_cast<double>(share);
    }
    const double share = 1.0 - joins;
    return share >= min_share ? share : 0.0;
}

}  // namespace

MergeSumsOfLength& MergeSumsOfLength::operator+=(const MergeSumsOfLength& other)
{
    brought += other.brought;
    tested += other.tested;
    expected += other.expected;
    by_merges += other.by_merges;
    second_moment += other.second_moment;
    seen += other.seen;
    return *this;
}

void MergeSums::add(const PathContribution& path)
{
    const int edges = count_edges(path);
    // By the balance heuristic a weighted contribution is f over the sum of all densities.
    const double weighted = static_cast<double>(path.weight) * measured(measure_, path.unweighted);
    if (edges > static_cast<int>(lengths_.size()) || !std::isfinite(weighted)) {
        return;
    }
    MergeSumsOfLength& sums = lengths_[static_cast<std::size_t>(edges - 1)];
    sums.brought += path.merged ? weighted : 0.0;
    const double share = share_of_merges(path);
    if (!(share > 0.0)) {
        return;
    }
    const double g = std::min(1.0, share / full_share);
    const double sample = g * weighted / share;  // f over the sum of the densities of merges
    sums.expected += g * weighted;
    // Of all merges of a path of this length, roulette thins this one most.
    const double most = roulette_.max_weight({.s = edges, .t = 2});
    sums.second_moment.add(most * sample, most * weighted * g * sample);
    if (path.merged) {
        sums.tested += sample;
        sums.by_merges += g * weighted;
        sums.seen.add(sample, sample * sample);
    }
}

}  // namespace bdpt::eval
