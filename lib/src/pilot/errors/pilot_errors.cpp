#include "pilot/errors/pilot_errors.h"

#include "geometry/flush_denormals.h"
#include "pilot/cost_model.h"
#include "pilot/errors/choice_noise.h"
#include "pilot/errors/errors_by_value.h"
#include "pilot/errors/merged_paths.h"
#include "pilot/errors/qmc_variance_factor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

// The error excludes the brightest paths of a usual render, up to these limits.
constexpr double max_dots = 0.0003;           ///< number over that of the pixels
constexpr double max_light_of_dots = 0.0025;  ///< light over that of the image

/// The error of a candidate's brightest paths counts as far as it exceeds this many standard
/// errors: more than one, so that a single path of the pilot is no evidence.
constexpr double margin_of_dots = 1.25;

/// Cost of a camera path that leaves the scene at once, over that of the cost model: such rays meet
/// few boxes of the BVH.
constexpr double cost_of_background = 0.5;

void add_scaled(PerCandidate<double>& to, const PerCandidate<double>& errors, double factor)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        to[k] += errors[k] * factor;
    }
}

/// Errors of a part of a pilot's contributions.
struct PartOfErrors {
    PerCandidate<ErrorsByValue> of_paths{};
    PerCandidate<double> of_sums{};  ///< of the products of different paths of a sample
    PerCandidate<double> of_splats{};
    PerCandidate<PerCandidate<double>> covariances{};

    /// Adds the path, one of the pilot's `paths` per image of `pixels` pixels. Returns its errors.
    RemainingErrors add(const PathShares& path, double scale, const PerCandidate<double>& choice,
                        double pixels, double paths)
    {
        const RemainingErrors errors = remaining_errors(path, scale, choice);
        const PerCandidate<double> numbers = path.numbers();
        const double relative = path.mean() * std::sqrt(scale);
        PerCandidate<double> of_path;
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            of_path[k] = errors.sum(k) / paths;
            of_paths[k].add(relative / numbers[k], usual_samples * pixels / paths * numbers[k],
                            of_path[k]);
            of_splats[k] += errors.splats[k] / paths;
        }
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            add_scaled(covariances[k], of_path, of_path[k]);
        }
        return errors;
    }
    void add(const PartOfErrors& other)
    {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            of_paths[k].add(other.of_paths[k]);
            of_sums[k] += other.of_sums[k];
            of_splats[k] += other.of_splats[k];
            add_scaled(covariances[k], other.covariances[k], 1.0);
        }
    }
};

/// Errors that a path adds to a cell.
struct CellError {
    std::size_t cell;
    PerCandidate<double> camera{};
};

/// Returns the errors of a row of the grid, and writes those of its cells.
PartOfErrors compute_errors(const PilotRow& row, std::size_t first_cell,
                            const PilotContributions& contributions,
                            const PilotBrightness& brightness, const PerCandidate<double>& choice,
                            CellErrors& of_cells)
{
    constexpr int samples = PilotRow::samples_of_cell;
    PartOfErrors errors;
    for (const PilotContribution& path : row.joined()) {
        const RemainingErrors of_path =
            errors.add(path.shares, brightness.scale(path.cell), choice,
                       contributions.grid.pixels(), contributions.camera_paths() / path.number);
        add_scaled(of_cells.camera[path.cell], of_path.camera, path.number / samples);
    }
    const auto cells = static_cast<double>(contributions.grid.cells());
    for (std::size_t i = 0; i < row.cells().size(); ++i) {
        const PilotCell& cell = row.cells()[i];
        const double scale = brightness.scale(first_cell + i);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            double error = 0.0;
            for (std::size_t kind = 0; kind < PathShares::scattering_kinds; ++kind) {
                error += scale * left_of_sums[kind] * cell.sums[kind].variance(k, samples);
            }
            errors.of_sums[k] += error / cells;
            of_cells.camera[first_cell + i][k] += error;
            of_cells.costs[first_cell + i][k] =
                sample_cost(candidates[k], cell.stats, connection_rays(candidates[k], cell.stats));
        }
        if (cell.stats.rays.camera > cell.stats.paths.camera) {
            of_cells.scattering[first_cell + i] = 1.0;
        } else {
            for (double& cost : of_cells.costs[first_cell + i]) {
                cost *= cost_of_background;
            }
        }
    }
    return errors;
}

/// Returns the errors of splats, and adds those of cells to `of_cells`: what a splat says about
/// camera paths that are rare there.
PartOfErrors compute_errors(const PilotSplats& part, const PilotContributions& contributions,
                            const PilotBrightness& brightness, const PerCandidate<double>& choice,
                            std::vector<CellError>& of_cells)
{
    PartOfErrors errors;
    const auto cells = static_cast<double>(contributions.grid.cells());
    for (const PilotContribution& splat : part.contributions()) {
        const RemainingErrors of_splat =
            errors.add(splat.shares, brightness.scale(splat), choice, contributions.grid.pixels(),
                       contributions.splatted_pixels());
        CellError of_cell{.cell = splat.cell};
        add_scaled(of_cell.camera, of_splat.camera, cells / contributions.splatted_pixels());
        of_cells.push_back(of_cell);
    }
    return errors;
}

/// Returns the errors of merged paths, and adds those of cells to `of_cells`.
PartOfErrors compute_errors(std::span<const PilotContribution* const> merged,
                            const PilotContributions& contributions,
                            const PilotBrightness& brightness, const PerCandidate<double>& choice,
                            std::vector<CellError>& of_cells)
{
    PartOfErrors errors;
    const auto cells = static_cast<double>(contributions.grid.cells());
    for (const PilotContribution* path : merged) {
        const double paths = contributions.camera_paths() / path->number;
        const RemainingErrors of_path = errors.add(path->shares, brightness.scale(path->cell),
                                                   choice, contributions.grid.pixels(), paths);
        CellError of_cell{.cell = path->cell};
        add_scaled(of_cell.camera, of_path.camera, cells / paths);
        of_cells.push_back(of_cell);
    }
    return errors;
}

/// Sums in the same order for any number of threads, so that sums are bit-identical.
PilotErrors compute_errors(const PilotContributions& contributions,
                           const PilotBrightness& brightness)
{
    const PilotGrid& grid = contributions.grid;
    const std::size_t rows = contributions.rows.size();
    CellErrors of_cells{.camera = std::vector<PerCandidate<double>>(grid.cells()),
                        .costs = std::vector<PerCandidate<double>>(grid.cells()),
                        .scattering = std::vector<double>(grid.cells())};
    const PerCandidate<double> choice = measure_choice(contributions, brightness);
    // The parts: rows of camera paths, then splats, then groups of merged paths.
    constexpr std::size_t group = 1024;
    const std::vector<const PilotContribution*> merged =
        findable_merged_paths(contributions, brightness);
    const std::size_t before_merged = rows + contributions.parts.size();
    std::vector<PartOfErrors> parts(before_merged + (merged.size() + group - 1) / group);
    std::vector<std::vector<CellError>> added(parts.size() - rows);  // to errors of cells
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        if (i < rows) {
            parts[i] = compute_errors(contributions.rows[i], grid.index(0, static_cast<int>(i)),
                                      contributions, brightness, choice, of_cells);
        } else if (i < before_merged) {
            parts[i] = compute_errors(contributions.parts[i - rows], contributions, brightness,
                                      choice, added[i - rows]);
        } else {
            const std::size_t first = group * (i - before_merged);
            parts[i] = compute_errors(
                std::span(merged).subspan(first, std::min(group, merged.size() - first)),
                contributions, brightness, choice, added[i - rows]);
        }
    });
    PartOfErrors all;
    for (const PartOfErrors& part : parts) {
        all.add(part);
    }
    for (const std::vector<CellError>& part : added) {
        for (const CellError& error : part) {
            add_scaled(of_cells.camera[error.cell], error.camera, 1.0);
        }
    }
    of_cells.splats = all.of_splats;
    PilotErrors errors{.covariances = all.covariances, .of_cells = std::move(of_cells)};
    const double dots = max_dots * grid.pixels();
    const double light = max_light_of_dots * usual_samples * grid.pixels();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double usual = all.of_paths[k].without_brightest(dots, light);
        const double dots_of_all = all.of_paths[k].without_brightest(0.0, 0.0) - usual;
        errors.of_image[k] = usual + all.of_sums[k];
        errors.of_cells.dots[k] = dots_of_all;
        errors.sure_dots[k] =
            std::max(0.0, dots_of_all - margin_of_dots * std::sqrt(all.covariances[k][k]));
    }
    return errors;
}

/// Adds the expected error of rare paths that no pilot finds to all candidates, so that a small
/// gain does not justify a much more expensive one. Where the largest errors of single paths make
/// the sum noisy, still larger ones are likely.
void add_unseen(PilotErrors& errors)
{
    constexpr double most = 0.2;  // fraction of the error with one light path per camera path
    const auto found = std::find(candidates.begin(), candidates.end(), Candidate{1.0, 1.0});
    const auto one = static_cast<std::size_t>(found - candidates.begin());
    const double unseen =
        std::min(most * errors.of_image[one], 2.0 * std::sqrt(errors.covariances[one][one]));
    for (double& error : errors.of_image) {
        error += unseen;
    }
}

}  // namespace

PilotErrors predict_errors(const PilotContributions& contributions,
                           const PilotBrightness& brightness)
{
    PilotErrors errors = compute_errors(contributions, brightness);
    errors.light_is_rare = brightness.light_is_rare();
    // Where light is rare in the whole image, the pilot's errors consist of rare paths already.
    if (!errors.light_is_rare) {
        add_unseen(errors);
    }
    return errors;
}

}  // namespace bdpt
