#include "pilot/merged_finds.h"

#include "pilot/left_by_sobol.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt {
namespace {

constexpr double usual_samples = 64.0;  // per pixel

struct MergedFind {
    const PathShares* shares;
    double scale;   // of its square in relMSE
    double value;   // where a camera path finds such a path, relative to the brightness there
    double number;  // of such paths in a usual render
};

/// Those that some candidate can find, the brightest first.
std::vector<MergedFind> brightest_first(const PilotFinds& finds, const PilotBrightness& brightness)
{
    const double renders = usual_samples * finds.grid.pixels() / finds.camera_paths();
    std::vector<MergedFind> merged;
    for (const PilotRow& row : finds.rows) {
        for (const PilotFind& find : row.merged()) {
            if (find.shares.found_by_one() > 0.0) {
                const double scale = brightness.scale(find.cell);
                merged.push_back({.shares = &find.shares,
                                  .scale = scale,
                                  .value = std::sqrt(scale) * find.shares.value(),
                                  .number = renders * find.shares.found_by_one()});
            }
        }
    }
    // Equal ones stay in their order, so that sums have the same bits.
    std::stable_sort(merged.begin(), merged.end(),
                     [](const MergedFind& a, const MergedFind& b) { return a.value > b.value; });
    return merged;
}

}  // namespace

PerCandidate<double> merged_errors(const PilotFinds& finds, const PilotBrightness& brightness)
{
    PerCandidate<double> errors{};
    double found = 0.0;
    for (const MergedFind& find : brightest_first(finds, brightness)) {
        found += find.number;
        if (found < 1.0) {
            continue;
        }
        const PerCandidate<double> left = remaining_errors(*find.shares, find.scale);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            errors[k] += left[k] / finds.camera_paths();
        }
    }
    return errors;
}

double share_of_merging_alone(const PilotFinds& finds, const PilotBrightness& brightness)
{
    double merged = 0.0;
    for (const PilotRow& row : finds.rows) {
        for (const PilotFind& find : row.merged()) {
            merged += find.shares.merged_mean();
        }
    }
    merged /= finds.camera_paths();
    return merged > 0.0 ? merged / (merged + brightness.average()) : 0.0;
}

}  // namespace bdpt
