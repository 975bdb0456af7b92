#include "pilot/pilot.h"

#include "geometry/flush_denormals.h"
#include "integrator/bidirectional/bidirectional_integrator.h"
#include "path/strategy_set.h"
#include "pilot/pilot_brightness.h"
#include "pilot/prices.h"
#include "pilot/seen_lamps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace bdpt {
namespace {

/// A point of a light is joined to the lens.
constexpr Strategy see_lamp{.s = 1, .t = 1};

RenderOptions pilot_options(RenderOptions options)
{
    constexpr std::uint64_t seed = 0x70696c6f74;  // one that nobody will choose
    // Longer paths bring little, and would cost a pilot more time and memory than it is worth.
    constexpr int longest_path = 32;  // [edges]
    options.integrator = IntegratorKind::bdpt;
    options.film.crop.reset();
    options.sampling.sampler = SamplerKind::independent;
    options.sampling.seed = seed;
    options.transport.max_depth =
        std::min(options.transport.max_depth, std::max(longest_path, options.transport.min_depth));
    options.bidirectional = {};
    options.bidirectional.light_paths = PathShares::pilot_light_paths;
    options.bidirectional.connections = PathShares::pilot_light_paths;
    return options;
}

/// Always in the same order, so that sums have the same bits.
PerCandidate<double> errors_of(const PilotGrid& grid, std::span<const PilotRow> rows,
                               const PilotBrightness& brightness)
{
    PerCandidate<double> errors{};
    const auto cells = static_cast<double>(grid.cells());
    std::size_t index = 0;
    for (const PilotRow& row : rows) {
        for (const PilotCell& cell : row.cells()) {
            const double scale = brightness.scale(index++) / cells;
            for (std::size_t k = 0; k < candidates.size(); ++k) {
                errors[k] += scale * cell.variances[k];
            }
        }
        for (const PilotSplat& splat : row.splats()) {
            const double scale = brightness.scale(splat) / (cells * PilotRow::samples_of_cell);
            const PerCandidate<double> variances = remaining_variances(splat.shares);
            for (std::size_t k = 0; k < candidates.size(); ++k) {
                errors[k] += scale * variances[k];
            }
        }
    }
    return errors;
}

/// Adds what rare paths that no pilot finds may bring to any candidate, so that a small gain does
/// not pay for a much dearer one: where few paths find most of the light, half of the error and
/// more is of that kind.
PerCandidate<double> with_unseen(PerCandidate<double> errors)
{
    constexpr double share =
        0.25;  // of the error of one light path of its own for each camera path
    const auto one = std::find_if(candidates.begin(), candidates.end(), [](const Candidate& c) {
        return c.light_paths == 1.0 && c.connections == 1.0;
    });
    const double unseen = share * errors[static_cast<std::size_t>(one - candidates.begin())];
    for (double& error : errors) {
        error += unseen;
    }
    return errors;
}

RenderOptions with_candidate(RenderOptions options, const Candidate& candidate, bool sees_lamps)
{
    if (!sees_lamps) {
        options.bidirectional.disabled = {see_lamp};
    }
    if (candidate.light_paths == 0.0) {
        options.integrator = IntegratorKind::mis;
        options.bidirectional.disabled.clear();
        return options;
    }
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = candidate.light_paths;
    options.bidirectional.connections = candidate.connections;
    return options;
}

/// relMSE that is worth telling from none: less is noise of the pilot, and images without any are
/// best where they cost least.
double error_of(const PilotResult& pilot, std::size_t candidate, bool sees_lamps)
{
    constexpr double least = 1e-4;
    return std::max(least, pilot.errors[candidate] +
                               (sees_lamps ? pilot.seen_lamps.by_both : pilot.seen_lamps.by_hits));
}

bool fits(const RenderOptions& options)
{
    return options.integrator == IntegratorKind::mis ||
           LightPathCache::bytes(LightPathCounts(options), StrategySet(options).light_vertices()) <=
               options.bidirectional.light_path_memory;
}

}  // namespace

PilotResult run_pilot(const World& world, const MovingCamera& camera, const RenderOptions& asked)
{
    const RenderOptions options = pilot_options(asked);
    const BidirectionalIntegrator integrator(world, camera, options);
    const PilotGrid grid(options.film.width, options.film.height);
    std::vector<PilotRow> rows(static_cast<std::size_t>(grid.rows()));
    tbb::parallel_for(0, grid.rows(), [&](int row) {
        const FlushDenormals flush;
        rows[static_cast<std::size_t>(row)].render(integrator, grid, options.transport.heuristic,
                                                   row);
    });
    const PilotBrightness brightness(grid, rows);
    PilotResult result{.errors = with_unseen(errors_of(grid, rows, brightness)),
                       .seen_lamps = seen_lamp_errors(grid, rows, brightness),
                       .costs = {},
                       .stats = {}};
    // Rays to lamps that are seen are none of next-event estimation.
    std::uint64_t to_lamps = 0;
    for (const PilotRow& row : rows) {
        result.stats += row.stats();
        to_lamps += row.lamps().size();
    }
    RenderStats without_lamps = result.stats;
    without_lamps.rays.shadow -= to_lamps;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result.costs[k] = sample_cost(candidates[k], without_lamps);
    }
    return result;
}

RenderOptions with_best(const PilotResult& pilot, const RenderOptions& asked)
{
    std::optional<RenderOptions> best;
    double least = 0.0;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        for (const bool sees_lamps : {false, true}) {
            if (sees_lamps && candidates[k].light_paths == 0.0) {
                continue;  // path tracing does not
            }
            const double product = error_of(pilot, k, sees_lamps) *
                                   (pilot.costs[k] + (sees_lamps ? seen_lamp_cost : 0.0));
            RenderOptions options = with_candidate(asked, candidates[k], sees_lamps);
            if ((!best || product < least) && fits(options)) {
                best = std::move(options);
                least = product;
            }
        }
    }
    return *best;
}

}  // namespace bdpt
