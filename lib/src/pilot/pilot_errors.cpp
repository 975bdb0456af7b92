#include "pilot/pilot_errors.h"

#include "geometry/flush_denormals.h"
#include "pilot/errors_by_value.h"
#include "pilot/merged_paths.h"
#include "pilot/qmc_variance_factor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

// The brightest paths of a usual render do not count, up to these limits.
constexpr double max_dots = 0.0003;           ///< number over that of the pixels
constexpr double max_light_of_dots = 0.0025;  ///< light over that of the image

/// Errors of a part of a pilot's contributions.
struct PartOfErrors {
    PerCandidate<ErrorsByValue> of_paths{};
    PerCandidate<double> of_sums{};  ///< of the products of different paths of a sample

    /// Adds the path, one of the pilot's `paths` per image of `pixels` pixels.
    void add(const PathShares& path, double scale, double pixels, double paths)
    {
        const PerCandidate<double> errors = remaining_errors(path, scale);
        const PerCandidate<double> numbers = path.numbers();
        const double relative = path.mean() * std::sqrt(scale);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            of_paths[k].add(relative / numbers[k], usual_samples * pixels / paths * numbers[k],
                            errors[k] / paths);
        }
    }
    void add(const PartOfErrors& other)
    {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            of_paths[k].add(other.of_paths[k]);
            of_sums[k] += other.of_sums[k];
        }
    }
};

/// Returns the errors of a row of the grid.
PartOfErrors compute_errors(const PilotRow& row, std::size_t first_cell,
                            const PilotContributions& contributions,
                            const PilotBrightness& brightness)
{
    PartOfErrors errors;
    for (const PilotContribution& path : row.joined()) {
        errors.add(path.shares, brightness.scale(path.cell), contributions.grid.pixels(),
                   contributions.camera_paths());
    }
    for (std::size_t i = 0; i < row.cells().size(); ++i) {
        const PilotCell& cell = row.cells()[i];
        const double scale =
            brightness.scale(first_cell + i) / static_cast<double>(contributions.grid.cells());
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            constexpr int samples = PilotRow::samples_of_cell;
            errors.of_sums[k] +=
                scale * (left_of_direct_sums * cell.direct.variance(k, samples) +
                         left_of_indirect_sums * cell.indirect.variance(k, samples));
        }
    }
    return errors;
}

PartOfErrors compute_errors(const PilotSplats& part, const PilotContributions& contributions,
                            const PilotBrightness& brightness)
{
    PartOfErrors errors;
    for (const PilotContribution& splat : part.contributions()) {
        errors.add(splat.shares, brightness.scale(splat), contributions.grid.pixels(),
                   contributions.splatted_pixels());
    }
    return errors;
}

/// Sums in the same order for any number of threads, so that sums are bit-identical.
PerCandidate<double> compute_errors(const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    const std::size_t rows = contributions.rows.size();
    std::vector<PartOfErrors> parts(rows + contributions.parts.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        parts[i] = i < rows
                       ? compute_errors(contributions.rows[i],
                                        contributions.grid.index(0, static_cast<int>(i)),
                                        contributions, brightness)
                       : compute_errors(contributions.parts[i - rows], contributions, brightness);
    });
    PartOfErrors all;
    for (const PilotContribution* path : findable_merged_paths(contributions, brightness)) {
        all.add(path->shares, brightness.scale(path->cell), contributions.grid.pixels(),
                contributions.camera_paths());
    }
    for (const PartOfErrors& part : parts) {
        all.add(part);
    }
    PerCandidate<double> errors;
    const double pixels = contributions.grid.pixels();
    const double dots = max_dots * pixels;
    const double light = max_light_of_dots * usual_samples * pixels;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        errors[k] = all.of_paths[k].without_brightest(dots, light) + all.of_sums[k];
    }
    return errors;
}

/// Adds the expected error of rare paths that no pilot finds to all candidates, so that a small
/// gain does not justify a much more expensive one.
PerCandidate<double> with_unseen(PerCandidate<double> errors)
{
    constexpr double share = 0.2;  // fraction of the error with one light path per camera path
    const auto one = std::find_if(candidates.begin(), candidates.end(), [](const Candidate& c) {
        return c.light_paths == 1.0 && c.connections == 1.0;
    });
    const double unseen = share * errors[static_cast<std::size_t>(one - candidates.begin())];
    for (double& error : errors) {
        error += unseen;
    }
    return errors;
}

}  // namespace

PerCandidate<double> predicted_errors(const PilotContributions& contributions,
                                      const PilotBrightness& brightness)
{
    return with_unseen(compute_errors(contributions, brightness));
}

}  // namespace bdpt
