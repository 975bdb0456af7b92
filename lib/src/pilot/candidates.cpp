#include "pilot/candidates.h"

#include "pilot/pilot_constants.h"

#include <cmath>

namespace bdpt {
namespace {

constexpr const CostModel& cost_model = pilot_constants.cost;

double cost_path(const CostModel::Path& path, double segments, double shadow_rays)
{
    return path.sample + path.segment * segments + path.shadow * shadow_rays;
}

double per(std::uint64_t count, std::uint64_t of)
{
    return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of);
}

}  // namespace

double connection_rays(const Candidate& candidate, const RenderStats& pilot)
{
    const std::uint64_t connected = pilot_constants.sampling.connections * pilot.paths.camera;
    const double all = candidate.connections * per(pilot.rays.shadow_interior, connected);
    const double wanted = candidate.connection_rays;
    // Where there are few, some are chosen twice.
    return wanted > 0.0 && all > 0.0 ? wanted * all / std::sqrt(wanted * wanted + all * all) : all;
}

double sample_cost(const Candidate& candidate, const RenderStats& pilot, double connection_rays,
                   double background)
{
    const RayCounts& rays = pilot.rays;
    const double segments =
        per(rays.camera, pilot.paths.camera) - (1.0 - cost_model.background_segment) * background;
    const double next_event =
        candidate.light_samples *
        per(rays.shadow - rays.shadow_to_lens - rays.shadow_interior, pilot.paths.camera);
    if (candidate.light_paths == 0.0) {
        return cost_path(cost_model.path_tracing, segments, next_event);
    }
    const double light = cost_path(cost_model.light_path, per(rays.light, pilot.paths.light),
                                   per(rays.shadow_to_lens, pilot.paths.light));
    if (candidate.connections == 0.0) {
        return cost_path(cost_model.camera_path, segments, next_event) +
               candidate.light_paths * light;
    }
    const bool own = candidate.light_paths == candidate.connections && candidate.light_paths >= 1.0;
    const double pairs = segments * per(rays.light, pilot.paths.light);
    const double choice = candidate.connection_rays > 0.0 ? cost_model.estimate * pairs
                          : own                           ? 0.0
                                                          : cost_model.shared_choice;
    return cost_path(cost_model.camera_path, segments, next_event) +
           cost_model.light_paths_of_sample +
           candidate.light_paths * (light + (own ? 0.0 : cost_model.shared_light_path)) +
           candidate.connections * choice +
           (candidate.connection_rays > 0.0 ? cost_model.chosen_connection
                                            : cost_model.connection) *
               connection_rays;
}

}  // namespace bdpt
