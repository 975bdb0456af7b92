#include "pilot/rare_paths.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

void ErrorsByValue::add(double value, double number, double error) noexcept
{
    if (!(number > 0.0)) {
        never_found_ += error;
        return;
    }
    const int last = static_cast<int>(octaves_.size()) - 1;
    // ilogb of zero is less than all exponents, and that of infinity is greater.
    const int exponent = std::clamp(std::ilogb(value), least_exponent, least_exponent + last);
    Octave& octave = octaves_[static_cast<std::size_t>(exponent - least_exponent)];
    octave.number += number;
    octave.light += number * value;
    octave.errors += error;
}

void ErrorsByValue::add(const ErrorsByValue& other) noexcept
{
    for (std::size_t i = 0; i < octaves_.size(); ++i) {
        octaves_[i].number += other.octaves_[i].number;
        octaves_[i].light += other.octaves_[i].light;
        octaves_[i].errors += other.octaves_[i].errors;
    }
    never_found_ += other.never_found_;
}

double ErrorsByValue::without_brightest(double number, double light) const noexcept
{
    double errors = never_found_;
    double excluded = 1.0;  // fraction of the octave
    for (std::size_t i = octaves_.size(); i-- > 0;) {
        const Octave& octave = octaves_[i];
        if (!(octave.number > 0.0)) {
            continue;
        }
        // Below the octave that reached the limit, everything counts.
        excluded =
            excluded < 1.0 ? 0.0 : std::min({1.0, number / octave.number, light / octave.light});
        number -= excluded * octave.number;
        light -= excluded * octave.light;
        errors += (1.0 - excluded) * octave.errors;
    }
    return errors;
}

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
