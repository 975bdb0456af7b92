#include "pilot/pilot_errors.h"

#include "geometry/flush_denormals.h"
#include "math/elementary.h"
#include "pilot/candidates.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

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
    const double renders = pilot_constants.rare.usual_samples * contributions.grid.pixels() /
                           contributions.camera_paths();
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

namespace {

void add_scaled(PerCandidate<double>& to, const PerCandidate<double>& values, double factor)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        to[k] += values[k] * factor;
    }
}

/// Second moments of paths that connections found.
struct ChoiceMoments {
    PerCandidate<double> choice{};
    PerCandidate<double> connections{};
};

ChoiceMoments moments_of(const PilotRow& row, const PilotBrightness& brightness)
{
    ChoiceMoments sum;
    for (const PilotContribution& path : row.joined()) {
        if (path.shares.choice_is_known()) {
            const PathShares::SecondMoments moments = path.shares.second_moments();
            const double scale = brightness.scale(path.cell) * path.number;
            add_scaled(sum.choice, moments.choice, scale);
            add_scaled(sum.connections, moments.connections, scale);
        }
    }
    return sum;
}

}  // namespace

PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    std::vector<ChoiceMoments> rows(contributions.rows.size());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        rows[i] = moments_of(contributions.rows[i], brightness);
    });
    ChoiceMoments all;
    for (const ChoiceMoments& row : rows) {
        add_scaled(all.choice, row.choice, 1.0);
        add_scaled(all.connections, row.connections, 1.0);
    }
    PerCandidate<double> result{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = all.connections[k] > 0.0 ? all.choice[k] / all.connections[k] : 0.0;
    }
    return result;
}

namespace {

constexpr const QmcVarianceFactors& qmc_factors = pilot_constants.qmc;
constexpr const RarePathConstants& rare_constants = pilot_constants.rare;

/// Returns the remaining fraction for paths that camera paths find alone: 1 for rare paths, as a
/// single sample is not stratified. `value` is the path's contribution relative to the local
/// brightness: at most one in that many samples finds one.
double own_factor(const PathShares& shares, double value)
{
    if (shares.kind() == PathShares::in_body) {
        return qmc_factors.in_body;
    }
    if (shares.kind() == PathShares::direct) {
        return qmc_factors.direct;
    }
    return qmc_factors.indirect + (1.0 - qmc_factors.indirect) * value / (value + qmc_factors.rare);
}

/// Returns the remaining fraction by number of connections: more connections of a sample are more
/// points of one sequence, which reduce the remaining variance of each.
PerCandidate<double> connection_factors()
{
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const auto c = static_cast<float>(std::max(1.0, candidates[k].connections));
        result[k] = exp_exact(-log_exact(c) / 3.0f);
    }
    return result;
}

}  // namespace

RemainingErrors remaining_errors(const PathShares& shares, double scale,
                                 const PerCandidate<double>& choice)
{
    RemainingErrors result;
    if (shares.kind() == PathShares::seen) {
        return result;  // directly visible light is accounted for separately
    }
    const double per_brightness = std::sqrt(scale);
    const PathShares::SecondMoments moments = shares.second_moments();
    const PerCandidate<double> values = shares.own_values();
    static const PerCandidate<double> of_connections = connection_factors();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double own = own_factor(shares, values[k] * per_brightness);
        const double connections = shares.kind() == PathShares::in_body
                                       ? qmc_factors.in_body
                                       : qmc_factors.connections * of_connections[k];
        const double of_choice =
            shares.choice_is_known() ? moments.choice[k] : choice[k] * moments.connections[k];
        result.camera[k] = scale * (own * moments.own[k] + connections * moments.connections[k] +
                                    qmc_factors.choice * of_choice);
        result.splats[k] = scale * moments.splats[k];
    }
    return result;
}

namespace {

std::vector<PilotLamp> by_pixel(const PilotContributions& contributions)
{
    std::vector<PilotLamp> lamps;
    for (const PilotRow& row : contributions.rows) {
        lamps.insert(lamps.end(), row.lamps().begin(), row.lamps().end());
    }
    // Stable, so that sums are bit-identical.
    std::stable_sort(lamps.begin(), lamps.end(), [](const PilotLamp& a, const PilotLamp& b) {
        return std::pair(a.y, a.x) < std::pair(b.y, b.x);
    });
    return lamps;
}

/// Returns the variance of hits in one pixel that the light partly fills, as far as Sobol points
/// leave it [nit^2].
double variance_of_hits(std::span<const PilotLamp> pixel, double points_per_pixel)
{
    double light = 0.0;
    double filled = 0.0;
    for (const PilotLamp& lamp : pixel) {
        light += lamp.value / points_per_pixel;
        filled += lamp.value / (points_per_pixel * lamp.radiance);
    }
    if (!(filled > 0.0)) {
        return 0.0;
    }
    const double radiance = light / filled;
    const double part = std::min(1.0, filled);
    return qmc_factors.direct * radiance * radiance * part * (1.0 - part);
}

}  // namespace

VisibleLightErrors visible_light_errors(const PilotContributions& contributions,
                                        const PilotBrightness& brightness,
                                        const RenderOptions& options)
{
    const double samples = options.bidirectional.visible_light_samples;
    const auto weight = [&](const PilotLamp& lamp) {
        const double odds = samples * lamp.odds;
        const double raised = options.transport.heuristic == Heuristic::power ? odds * odds : odds;
        return raised / (1.0 + raised);
    };
    const double points = contributions.camera_paths();
    const double pixels = contributions.grid.pixels();
    const std::vector<PilotLamp> lamps = by_pixel(contributions);
    VisibleLightErrors errors;
    for (auto first = lamps.begin(); first != lamps.end();) {
        const auto last = std::find_if(first, lamps.end(), [first](const PilotLamp& lamp) {
            return lamp.x != first->x || lamp.y != first->y;
        });
        const double hits = brightness.scale(first->cell) *
                            variance_of_hits({first, last}, points / pixels) / pixels;
        errors.by_hits += hits;
        const double left = 1.0 - weight(*first);
        errors.by_both += left * left * hits;
        for (; first != last; ++first) {
            const double weighted = weight(*first) * first->value;
            errors.by_both +=
                brightness.scale(first->cell) * weighted * weighted / (samples * points);
        }
    }
    return errors;
}

namespace {

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
            of_paths[k].add(relative / numbers[k],
                            rare_constants.usual_samples * pixels / paths * numbers[k], of_path[k]);
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
                error += scale * qmc_factors.sums[kind] * cell.sums[kind].variance(k, samples);
            }
            errors.of_sums[k] += error / cells;
            of_cells.camera[first_cell + i][k] += error;
            of_cells.costs[first_cell + i][k] = sample_cost(
                candidates[k], cell.stats, connection_rays(candidates[k], cell.stats), 0.0);
        }
        if (cell.stats.rays.camera > cell.stats.paths.camera) {
            of_cells.scattering[first_cell + i] = 1.0;
        } else {
            for (double& cost : of_cells.costs[first_cell + i]) {
                cost *= pilot_constants.cost.background_cell;
            }
        }
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
    // What splats and merged paths say about camera paths that are rare there.
    const auto add_rare = [&](const PilotContribution& path, double scale, double paths,
                              std::size_t part) {
        const RemainingErrors of_path =
            parts[part].add(path.shares, scale, choice, grid.pixels(), paths);
        CellError of_cell{.cell = path.cell};
        add_scaled(of_cell.camera, of_path.camera, static_cast<double>(grid.cells()) / paths);
        added[part - rows].push_back(of_cell);
    };
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        if (i < rows) {
            parts[i] = compute_errors(contributions.rows[i], grid.index(0, static_cast<int>(i)),
                                      contributions, brightness, choice, of_cells);
        } else if (i < before_merged) {
            for (const PilotContribution& splat : contributions.parts[i - rows].contributions()) {
                add_rare(splat, brightness.scale(splat), contributions.splatted_pixels(), i);
            }
        } else {
            const std::size_t first = group * (i - before_merged);
            for (const PilotContribution* path :
                 std::span(merged).subspan(first, std::min(group, merged.size() - first))) {
                add_rare(*path, brightness.scale(path->cell),
                         contributions.camera_paths() / path->number, i);
            }
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
    const double fireflies = rare_constants.max_fireflies * grid.pixels();
    const double light =
        rare_constants.max_light_of_fireflies * rare_constants.usual_samples * grid.pixels();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double usual = all.of_paths[k].without_brightest(fireflies, light);
        const double all_fireflies = all.of_paths[k].without_brightest(0.0, 0.0) - usual;
        errors.of_image[k] = usual + all.of_sums[k];
        errors.of_cells.fireflies[k] = all_fireflies;
        errors.sure_fireflies[k] =
            std::max(0.0, all_fireflies - rare_constants.margin_of_fireflies *
                                              std::sqrt(all.covariances[k][k]));
    }
    return errors;
}

/// Adds the expected error of rare paths that no pilot finds to all candidates, so that a small
/// gain does not justify a much more expensive one. Where the largest errors of single paths make
/// the sum noisy, still larger ones are likely.
void add_unseen(PilotErrors& errors)
{
    const auto found = std::find(candidates.begin(), candidates.end(), Candidate{1.0, 1.0});
    const auto one = static_cast<std::size_t>(found - candidates.begin());
    const double unseen =
        std::min(rare_constants.max_unseen * errors.of_image[one],
                 rare_constants.unseen_standard_errors * std::sqrt(errors.covariances[one][one]));
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
