#include "pilot/pilot.h"

#include "geometry/flush_denormals.h"
#include "integrator/bidirectional/bidirectional_integrator.h"
#include "pilot/candidates.h"
#include "pilot/pilot_errors.h"
#include "rates/rate_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace bdpt {

RenderOptions with_candidate(RenderOptions options, const Candidate& candidate)
{
    options.sampling.light_samples *= static_cast<int>(candidate.light_samples);
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

double planned_paths(const RenderOptions& options)
{
    const std::int64_t samples = options.sampling.planned_samples;
    return samples == 0 ? std::numeric_limits<double>::infinity()
                        : static_cast<double>(samples) * options.film.width * options.film.height;
}

namespace {

/// Returns the number of cells that are worth their time.
double affordable_cells(const RenderOptions& options)
{
    constexpr const PilotSampling& sampling = pilot_constants.sampling;
    return std::min(sampling.max_cells, planned_paths(options) / sampling.samples_per_cell);
}

}  // namespace

bool is_worth_measuring(const RenderOptions& options)
{
    return affordable_cells(options) >=
           std::min(pilot_constants.sampling.fewest_cells,
                    static_cast<double>(options.film.width) * options.film.height);
}

namespace {

std::uint64_t cache_bytes(const RenderOptions& options)
{
    return LightPathCache::bytes(LightPathCounts(options), LightPathCache::usual_vertices(options));
}

RenderOptions pilot_options(RenderOptions options, const PilotGrid& grid)
{
    constexpr const PilotSampling& sampling = pilot_constants.sampling;
    const std::uint64_t memory = options.bidirectional.light_path_memory;
    options.integrator = IntegratorKind::vcm;
    options.film.crop.reset();
    options.sampling.sampler = SamplerKind::independent;
    options.sampling.seed = sampling.seed;
    options.transport.max_depth =
        std::min(options.transport.max_depth,
                 std::max(sampling.max_path_length, options.transport.min_depth));
    // Required to detect light found by merging alone; candidates use the requested heuristic.
    options.transport.heuristic = Heuristic::balance;
    options.bidirectional = {};
    options.bidirectional.connections = PathShares::pilot_connections;
    options.bidirectional.connection_rays = PathShares::pilot_rays;
    options.bidirectional.visible_light_samples = 1.0;
    options.bidirectional.merge_radius = sampling.merge_radius;
    options.bidirectional.merge_alpha = 1.0;
    options.bidirectional.max_merges = sampling.max_merges;
    // One light path per connection of camera paths, if memory allows that.
    options.bidirectional.light_paths =
        PathShares::pilot_connections * static_cast<double>(grid.cells()) / grid.pixels();
    const auto wanted = static_cast<double>(cache_bytes(options));
    const double allowed = std::max(1.0, static_cast<double>(memory));
    options.bidirectional.light_paths *= std::min(1.0, allowed / wanted);
    return options;
}

/// Tests whether a render may take the candidate. A number of light samples that was asked for
/// stays. Some are not predicted well: in bodies that scatter light, the choice of connections does
/// not know how fast light is attenuated; and light samples of one vertex that come from lamps,
/// small or hidden from it, are more alike than the pilot assumes.
bool is_suitable(const Candidate& candidate, const World& world, const RenderOptions& asked)
{
    if (candidate.connection_rays > 0.0 && world.media().any_body_scatters()) {
        return false;
    }
    return candidate.light_samples == 1.0 ||
           (asked.sampling.light_samples == 1 && world.lights().environment().has_value());
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

/// Tests whether the light paths of a render fit into the memory that it may use for them.
bool fits(const RenderOptions& options, const RenderStats& pilot)
{
    if (options.integrator == IntegratorKind::mis) {
        return true;
    }
    const PathCounts& paths = pilot.paths;
    const double measured = paths.light == 0 ? 0.0
                                             : 1.0 + static_cast<double>(pilot.rays.light) /
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
    // Light paths that are merged form one batch.
    const ChunkRange chunks = integrator.begin_batch({.begin = index, .end = index + 1}, 0);
    contributions.parts.resize(static_cast<std::size_t>(chunks.end));
    tbb::parallel_for(chunks.begin, chunks.end, [&](std::int64_t part) {
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

PilotMeasurements measure(const World& world, const MovingCamera& camera,
                          const RenderOptions& asked, const LearnedLight* learned,
                          const std::stop_token& abandon)
{
    const PilotGrid grid(asked.film.width, asked.film.height,
                         std::max(1.0, affordable_cells(asked)));
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
    PilotMeasurements result{
        .errors = errors.of_image,
        .covariances = errors.covariances,
        .visible_lights = visible_light_errors(contributions, brightness, asked),
        .fireflies = errors.sure_fireflies,
        .costs = {},
        .ruled_out = {},
        .merging_alone = share_of_merging_alone(contributions, brightness),
        .light_is_rare = errors.light_is_rare,
        .grid = grid,
        .cells = std::move(errors.of_cells),
        .stats = {}};
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
    const double background = 1.0 - mean_of(result.cells.scattering);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result.costs[k] =
            sample_cost(candidates[k], without_lamps,
                        mean_connection_rays(candidates[k], contributions), background);
        result.ruled_out[k] = !is_suitable(candidates[k], world, asked) ||
                              !fits(with_candidate(asked, candidates[k]), result.stats);
    }
    return result;
}

}  // namespace bdpt
