#include "pilot/merging_errors.h"

#include "pilot/qmc_variance_factor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt {
namespace {

constexpr double usual_samples = 64.0;  // per pixel

struct MergedContribution {
    const PathShares* shares;
    double scale;   // factor of its square in relMSE
    double value;   // value if a camera path finds such a path, relative to the local brightness
    double number;  // expected number of such paths in a usual render
};

/// Returns the contributions that some candidate can find, the brightest first.
std::vector<MergedContribution> brightest_first(const PilotContributions& contributions,
                                                const PilotBrightness& brightness)
{
    const double renders =
        usual_samples * contributions.grid.pixels() / contributions.camera_paths();
    std::vector<MergedContribution> merged;
    for (const PilotRow& row : contributions.rows) {
        for (const PilotContribution& contribution : row.merged()) {
            if (contribution.shares.found_by_one() > 0.0) {
                const double scale = brightness.scale(contribution.cell);
                merged.push_back({.shares = &contribution.shares,
                                  .scale = scale,
                                  .value = std::sqrt(scale) * contribution.shares.value(),
                                  .number = renders * contribution.shares.found_by_one()});
            }
        }
    }
    // Stable, so that sums are bit-identical.
    std::stable_sort(
        merged.begin(), merged.end(),
        [](const MergedContribution& a, const MergedContribution& b) { return a.value > b.value; });
    return merged;
}

}  // namespace

PerCandidate<double> merged_errors(const PilotContributions& contributions,
                                   const PilotBrightness& brightness)
{
    PerCandidate<double> errors{};
    double found = 0.0;
    for (const MergedContribution& contribution : brightest_first(contributions, brightness)) {
        found += contribution.number;
        if (found < 1.0) {
            continue;
        }
        const PerCandidate<double> left =
            remaining_errors(*contribution.shares, contribution.scale);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            errors[k] += left[k] / contributions.camera_paths();
        }
    }
    return errors;
}

double share_of_merging_alone(const PilotContributions& contributions,
                              const PilotBrightness& brightness)
{
    double merged = 0.0;
    for (const PilotRow& row : contributions.rows) {
        for (const PilotContribution& contribution : row.merged()) {
            merged += contribution.shares.merged_mean();
        }
    }
    merged /= contributions.camera_paths();
    return merged > 0.0 ? merged / (merged + brightness.average()) : 0.0;
}

}  // namespace bdpt
