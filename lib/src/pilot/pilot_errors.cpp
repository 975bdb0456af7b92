#include "pilot/pilot_errors.h"

#include "geometry/flush_denormals.h"
#include "pilot/merging_errors.h"
#include "pilot/qmc_variance_factor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

void add(const PerCandidate<double>& errors, double times, PerCandidate<double>& sum)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        sum[k] += times * errors[k];
    }
}

/// Returns the errors of a row of the grid.
PerCandidate<double> compute_errors(const PilotRow& row, std::size_t first_cell,
                                    const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    PerCandidate<double> errors{};
    for (const PilotContribution& contribution : row.joined()) {
        add(remaining_errors(contribution.shares, brightness.scale(contribution.cell)),
            1.0 / contributions.camera_paths(), errors);
    }
    for (std::size_t i = 0; i < row.cells().size(); ++i) {
        const PilotCell& cell = row.cells()[i];
        const double scale =
            brightness.scale(first_cell + i) / static_cast<double>(contributions.grid.cells());
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            constexpr int samples = PilotRow::samples_of_cell;
            errors[k] += scale * (left_of_direct_sums * cell.direct.variance(k, samples) +
                                  left_of_indirect_sums * cell.indirect.variance(k, samples));
        }
    }
    return errors;
}

PerCandidate<double> compute_errors(const PilotSplats& part,
                                    const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    PerCandidate<double> errors{};
    for (const PilotContribution& splat : part.contributions()) {
        add(remaining_errors(splat.shares, brightness.scale(splat)),
            1.0 / contributions.splatted_pixels(), errors);
    }
    return errors;
}

/// Sums in the same order for any number of threads, so that sums are bit-identical.
PerCandidate<double> compute_errors(const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    const std::size_t rows = contributions.rows.size();
    std::vector<PerCandidate<double>> errors(rows + contributions.parts.size());
    tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        errors[i] = i < rows
                        ? compute_errors(contributions.rows[i],
                                         contributions.grid.index(0, static_cast<int>(i)),
                                         contributions, brightness)
                        : compute_errors(contributions.parts[i - rows], contributions, brightness);
    });
    PerCandidate<double> sum = merged_errors(contributions, brightness);
    for (const PerCandidate<double>& part : errors) {
        add(part, 1.0, sum);
    }
    return sum;
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
