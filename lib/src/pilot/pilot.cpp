#include "pilot/pilot.h"

#include "geometry/flush_denormals.h"
#include "integrator/bidirectional/bidirectional_integrator.h"
#include "pilot/candidates.h"
#include "pilot/pilot_errors.h"
#include "pilot/rare_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace bdpt {
namespace {

std::uint64_t cache_bytes(const RenderOptions& options)
{
    return LightPathCache::bytes(LightPathCounts(options), LightPathCache::usual_vertices(options));
}

RenderOptions pilot_options(RenderOptions options, const PilotGrid& grid)
{
    constexpr std::uint64_t seed = 0x70696c6f74;  // a seed that users will hardly choose
    // Longer paths contribute little, and would cost a pilot more time and memory than they are
    // worth.
    constexpr int max_path_length = 32;  // [edges]
    const std::uint64_t memory = options.bidirectional.light_path_memory;
    options.integrator = IntegratorKind::vcm;
    options.film.crop.reset();
    options.sampling.sampler = SamplerKind::independent;
    options.sampling.seed = seed;
    options.transport.max_depth = std::min(options.transport.max_depth,
                                           std::max(max_path_length, options.transport.min_depth));
    // Required to detect light found by merging alone; candidates use the requested heuristic.
    options.transport.heuristic = Heuristic::balance;
    options.bidirectional = {};
    options.bidirectional.connections = PathShares::pilot_connections;
    options.bidirectional.connection_rays = PathShares::pilot_rays;
    options.bidirectional.visible_light_samples = 1.0;
    options.bidirectional.merge_radius = 0.005;
    options.bidirectional.merge_alpha = 1.0;
    options.bidirectional.max_merges = 32;  // usual scenes rarely have more
    // One light path per connection of camera paths, if memory allows that.
    options.bidirectional.light_paths =
        PathShares::pilot_connections * static_cast<double>(grid.cells()) / grid.pixels();
    const auto wanted = static_cast<double>(cache_bytes(options));
    const double allowed = std::max(1.0, static_cast<double>(memory));
    options.bidirectional.light_paths *= std::min(1.0, allowed / wanted);
    return options;
}

RenderOptions with_candidate(RenderOptions options, const Candidate& candidate)
{
    if (candidate.light_paths == 0.0) {
        options.integrator = IntegratorKind::mis;
        return options;
    }
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = candidate.light_paths;
    options.bidirectional.connections = candidate.connections;
    options.bidirectional.connection_rays = candidate.connection_rays;
    return options;
}

/// Rules out candidates that choose connections: in bodies that scatter light, the choice does not
/// know how fast light is attenuated.
void exclude_choice(PerCandidate<double>& errors)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (candidates[k].connection_rays > 0.0) {
            errors[k] = std::numeric_limits<double>::infinity();
        }
    }
}

/// Returns the number of connection rays, averaged over the image: where camera paths leave the
/// scene there are none.
double mean_connection_rays(const Candidate& candidate, const PilotContributions& contributions)
{
    double sum = 0.0;
    for (const PilotRow& row : contributions.rows) {
        for (const PilotCell& cell : row.cells()) {
            sum += connection_rays(candidate, cell.stats);
        }
    }
    return sum / static_cast<double>(contributions.grid.cells());
}

/// Returns the relMSE of an image by the candidate, at least the smallest that is distinguishable
/// from zero. Smaller values are noise of the pilot, and images without error are best where they
/// cost least.
double estimate_error(const PilotResult& pilot, std::size_t candidate)
{
    constexpr double least = 1e-4;
    // Path tracing has to hit lights that are directly visible.
    const double visible_lights = candidates[candidate].light_paths > 0.0
                                      ? pilot.visible_lights.by_both
                                      : pilot.visible_lights.by_hits;
    return std::max(least, pilot.errors[candidate] + visible_lights);
}

/// Returns the factor by which the candidate's error is multiplied in the choice.
double penalty(const PilotResult& pilot, std::size_t candidate, double error)
{
    // The square root: usual renders show few of these paths, and long ones more.
    const double by_dots = std::sqrt(1.0 + pilot.dots[candidate] / error);
    // What connections gain is often more than the pilot predicts.
    constexpr double margin_of_connections = 1.05;
    const Candidate& numbers = candidates[candidate];
    const bool splats_alone = numbers.light_paths > 0.0 && numbers.connections == 0.0;
    return by_dots * (splats_alone && numbers.light_paths <= 1.0 ? margin_of_connections : 1.0);
}

/// Returns whether the candidate is taken only for a gain that exceeds the noise of the prediction:
/// the choice of connections is predicted less well than all of them, and more light paths take
/// time from camera paths, whose rarest contributions no pilot finds.
bool needs_sure_gain(const Candidate& candidate)
{
    return candidate.connection_rays > 0.0 || candidate.light_paths > 1.0;
}

/// A candidate's product of error and cost, by which it is judged.
class Product {
public:
    Product(const PilotResult& pilot, std::size_t candidate)
        : candidate_(candidate), covariances_(&pilot.covariances)
    {
        const double error = estimate_error(pilot, candidate);
        per_error_ = penalty(pilot, candidate, error) * pilot.costs[candidate];
        value_ = error * per_error_;
    }

    [[nodiscard]] std::size_t candidate() const { return candidate_; }
    [[nodiscard]] bool operator<(const Product& other) const { return value_ < other.value_; }
    /// Returns whether this product is less than another by more than two standard errors of the
    /// difference.
    [[nodiscard]] bool surely_less(const Product& other) const
    {
        const std::size_t a = candidate_;
        const std::size_t b = other.candidate_;
        const PerCandidate<PerCandidate<double>>& covariances = *covariances_;
        const double variance = per_error_ * per_error_ * covariances[a][a] -
                                2.0 * per_error_ * other.per_error_ * covariances[a][b] +
                                other.per_error_ * other.per_error_ * covariances[b][b];
        return value_ + 2.0 * std::sqrt(std::max(0.0, variance)) < other.value_;
    }

private:
    std::size_t candidate_;
    const PerCandidate<PerCandidate<double>>* covariances_;
    double per_error_ = 0.0;
    double value_ = 0.0;
};

bool fits(const RenderOptions& options, const PilotResult& pilot)
{
    if (options.integrator == IntegratorKind::mis) {
        return true;
    }
    const PathCounts& paths = pilot.stats.paths;
    const double measured = paths.light == 0 ? 0.0
                                             : 1.0 + static_cast<double>(pilot.stats.rays.light) /
                                                         static_cast<double>(paths.light);
    const double usual = LightPathCache::usual_vertices(options);
    return LightPathCache::bytes(LightPathCounts(options), std::max(usual, measured)) <=
           options.bidirectional.light_path_memory;
}

/// Traces the light paths of sample `index`, and then the camera paths that are connected to them;
/// incomplete once `abandon` is requested.
void add_sample(std::int64_t index, Heuristic heuristic, BidirectionalIntegrator& integrator,
                PilotContributions& contributions, const std::stop_token& abandon)
{
    const std::int64_t parts = integrator.begin_pass({.begin = index, .end = index + 1});
    contributions.parts.resize(static_cast<std::size_t>(parts));
    tbb::parallel_for(std::int64_t{0}, parts, [&](std::int64_t part) {
        if (abandon.stop_requested()) {
            return;
        }
        const FlushDenormals flush;
        contributions.parts[static_cast<std::size_t>(part)].trace(
            integrator, part, index, contributions.grid, heuristic, contributions.light_paths);
    });
    if (abandon.stop_requested()) {
        return;
    }
    integrator.end_chunks();
    tbb::parallel_for(0, contributions.grid.rows(), [&](int row) {
        if (abandon.stop_requested()) {
            return;
        }
        const FlushDenormals flush;
        contributions.rows[static_cast<std::size_t>(row)].render(
            integrator, contributions.grid, heuristic, row, index, contributions.light_paths);
    });
}

}  // namespace

PilotResult run_pilot(const World& world, const MovingCamera& camera, const RenderOptions& asked,
                      const LearnedLight* learned, const std::stop_token& abandon)
{
    const PilotGrid grid(asked.film.width, asked.film.height);
    const RenderOptions options = pilot_options(asked, grid);
    BidirectionalIntegrator integrator(world, camera, options, learned);
    PilotContributions contributions{
        .grid = grid,
        .light_paths = LightPathCounts(options).per_camera_path,
        .rows = std::vector<PilotRow>(static_cast<std::size_t>(grid.rows())),
        .parts = {}};
    for (std::int64_t index = 0; index < PilotRow::samples_of_cell; ++index) {
        add_sample(index, asked.transport.heuristic, integrator, contributions, abandon);
        if (abandon.stop_requested()) {
            return {};
        }
    }
    const PilotBrightness brightness(contributions);
    PilotErrors errors = predict_errors(contributions, brightness);
    PilotResult result{.errors = errors.of_image,
                       .covariances = errors.covariances,
                       .visible_lights = visible_light_errors(contributions, brightness, asked),
                       .dots = errors.sure_dots,
                       .costs = {},
                       .merging_alone = share_of_merging_alone(contributions, brightness),
                       .light_is_rare = errors.light_is_rare,
                       .cells = std::move(errors.of_cells),
                       .stats = {}};
    if (world.media().any_body_scatters()) {
        exclude_choice(result.errors);
    }
    // Shadow rays to directly visible lights are not part of next-event estimation.
    std::uint64_t to_lamps = 0;
    for (const PilotRow& row : contributions.rows) {
        result.stats += row.stats();
        to_lamps += row.lamps().size();
    }
    for (const PilotSplats& part : contributions.parts) {
        result.stats += part.stats();
    }
    RenderStats without_lamps = result.stats;
    without_lamps.rays.shadow -= to_lamps;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result.costs[k] = sample_cost(candidates[k], without_lamps,
                                      mean_connection_rays(candidates[k], contributions));
    }
    return result;
}

RenderOptions with_best(const PilotResult& pilot, const RenderOptions& asked)
{
    std::optional<Product> usual;  // the least of those that need no sure gain
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Product product(pilot, k);
        if (!needs_sure_gain(candidates[k]) && (!usual || product < *usual) &&
            fits(with_candidate(asked, candidates[k]), pilot)) {
            usual = product;
        }
    }
    Product best = *usual;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Product product(pilot, k);
        if (needs_sure_gain(candidates[k]) && product < best && product.surely_less(*usual) &&
            fits(with_candidate(asked, candidates[k]), pilot)) {
            best = product;
        }
    }
    return with_candidate(asked, candidates[best.candidate()]);
}

std::shared_ptr<const SampleRates> best_rates(const PilotResult& pilot, const RenderOptions& chosen)
{
    Candidate numbers;
    if (chosen.integrator == IntegratorKind::bdpt) {
        numbers.light_paths = chosen.bidirectional.light_paths;
        numbers.connections =
            chosen.bidirectional.connections.value_or(chosen.bidirectional.light_paths);
        numbers.connection_rays = chosen.bidirectional.connection_rays;
    }
    const auto found = std::find(candidates.begin(), candidates.end(), numbers);
    return found == candidates.end() || pilot.light_is_rare
               ? nullptr
               : choose_rates(PilotGrid(chosen.film.width, chosen.film.height), pilot.cells,
                              static_cast<std::size_t>(found - candidates.begin()));
}

}  // namespace bdpt
