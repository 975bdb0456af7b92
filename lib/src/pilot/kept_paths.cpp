#include "pilot/kept_paths.h"

#include "math/random_numbers.h"

#include <algorithm>

namespace bdpt {
namespace {

/// A path's part of the sums that are estimated from all.
struct Part {
    double light;  ///< [nit]
    /// Squared error when found by one light path per camera path [nit^2]; 0 if no candidate can.
    double error;
};

Part part_of(const PilotContribution& path)
{
    const double mean = path.shares.mean();
    const double found = path.shares.found_by_one();
    return {.light = path.number * mean,
            .error = found > 0.0 ? path.number * mean * mean / found : 0.0};
}

double fraction(double part, double sum)
{
    return sum > 0.0 ? part / sum : 0.0;
}

}  // namespace

void keep_some(std::vector<PilotContribution>& paths, std::size_t first, std::uint64_t random)
{
    if (paths.size() - first <= kept_paths) {
        return;
    }
    Part all{};
    for (std::size_t i = first; i < paths.size(); ++i) {
        const Part part = part_of(paths[i]);
        all.light += part.light;
        all.error += part.error;
    }
    // Systematic sampling: one random number, then equal steps through the sum of all chances.
    constexpr double half = 0.5 * static_cast<double>(kept_paths);
    double at = static_cast<double>(split_mix(random) >> 11U) * 0x1p-53;
    std::size_t end = first;
    for (std::size_t i = first; i < paths.size(); ++i) {
        const Part part = part_of(paths[i]);
        const double chance = std::min(
            1.0, half * (fraction(part.light, all.light) + fraction(part.error, all.error)));
        at += chance;
        if (at >= 1.0) {
            at -= 1.0;
            paths[end] = paths[i];
            paths[end++].number /= chance;
        }
    }
    paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(end), paths.end());
}

}  // namespace bdpt
