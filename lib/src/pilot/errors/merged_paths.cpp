#include "pilot/errors/merged_paths.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

struct MergedPath {
    const PilotContribution* path;
    double value;  // when found by one light path per camera path, relative to the local brightness
    double number;  // found by a usual render of these
};

/// Returns the paths that some candidate can find, the brightest first.
std::vector<MergedPath> brightest_first(const PilotContributions& contributions,
                                        const PilotBrightness& brightness)
{
    const double renders =
        usual_samples * contributions.grid.pixels() / contributions.camera_paths();
    std::vector<MergedPath> merged;
    for (const PilotRow& row : contributions.rows) {
        for (const PilotContribution& path : row.merged()) {
            const double found = path.shares.found_by_one();
            if (found > 0.0) {
                const double relative = std::sqrt(brightness.scale(path.cell));
                merged.push_back({.path = &path,
                                  .value = relative * path.shares.mean() / found,
                                  .number = renders * found * path.number});
            }
        }
    }
    // Stable, so that sums are bit-identical.
    std::stable_sort(merged.begin(), merged.end(),
                     [](const MergedPath& a, const MergedPath& b) { return a.value > b.value; });
    return merged;
}

}  // namespace

std::vector<const PilotContribution*> findable_merged_paths(const PilotContributions& contributions,
                                                            const PilotBrightness& brightness)
{
    std::vector<const PilotContribution*> findable;
    double found = 0.0;
    for (const MergedPath& merged : brightest_first(contributions, brightness)) {
        found += merged.number;
        if (found >= 1.0) {
            findable.push_back(merged.path);
        }
    }
    return findable;
}

double share_of_merging_alone(const PilotContributions& contributions,
                              const PilotBrightness& brightness)
{
    double merged = 0.0;
    for (const PilotRow& row : contributions.rows) {
        for (const PilotContribution& path : row.merged()) {
            merged += path.shares.found_by_one() > 0.0 ? 0.0 : path.shares.mean() * path.number;
        }
    }
    merged /= contributions.camera_paths();
    return merged > 0.0 ? merged / (merged + brightness.average()) : 0.0;
}

}  // namespace bdpt
