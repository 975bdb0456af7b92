#include "pilot/candidates.h"

#include "pilot/path_shares.h"

#include <cmath>

namespace bdpt {
namespace {

/// Cost factors fitted to the CPU time of 48 scenes x 8 candidates, up to one factor per scene
/// (root mean square residual: 5 %), `light_paths_of_sample` to images of background. Only their
/// ratios matter [ns].
struct CostModel {
    double sample;
    double segment;  ///< segment of a walk
    double shadow;   ///< shadow ray of a connection, with its BSDFs and weights
};
constexpr CostModel path_tracing{.sample = 20.0, .segment = 305.0, .shadow = 285.0};
constexpr CostModel camera_path{.sample = 60.0, .segment = 345.0, .shadow = 310.0};
constexpr CostModel light_path{.sample = 20.0, .segment = 400.0, .shadow = 205.0};
constexpr double light_paths_of_sample = 80.0;  // to find those that it connects to
constexpr double connection = 200.0;            // its shadow ray
constexpr double chosen_connection = 245.0;  // likewise, of a vertex that is not yet in the cache
constexpr double estimate = 3.0;             // to choose connections, for each pair of vertices
constexpr double shared_light_path = 150.0;  // to store it in memory
constexpr double shared_choice = 30.0;       // to fetch it from there

double cost(const CostModel& model, double segments, double shadow_rays)
{
    return model.sample + model.segment * segments + model.shadow * shadow_rays;
}

double per(std::uint64_t count, std::uint64_t of)
{
    return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of);
}

}  // namespace

double connection_rays(const Candidate& candidate, const RenderStats& pilot)
{
    const std::uint64_t connected = PathShares::pilot_connections * pilot.paths.camera;
    const double all = candidate.connections * per(pilot.rays.shadow_interior, connected);
    const double wanted = candidate.connection_rays;
    // Where there are few, some are chosen twice.
    return wanted > 0.0 && all > 0.0 ? wanted * all / std::sqrt(wanted * wanted + all * all) : all;
}

double sample_cost(const Candidate& candidate, const RenderStats& pilot, double connection_rays)
{
    const RayCounts& rays = pilot.rays;
    const double segments = per(rays.camera, pilot.paths.camera);
    const double next_event =
        per(rays.shadow - rays.shadow_to_lens - rays.shadow_interior, pilot.paths.camera);
    if (candidate.light_paths == 0.0) {
        return cost(path_tracing, segments, next_event);
    }
    const double light = cost(light_path, per(rays.light, pilot.paths.light),
                              per(rays.shadow_to_lens, pilot.paths.light));
    if (candidate.connections == 0.0) {
        return cost(camera_path, segments, next_event) + candidate.light_paths * light;
    }
    const bool own = candidate.light_paths == candidate.connections && candidate.light_paths >= 1.0;
    const double pairs = segments * per(rays.light, pilot.paths.light);
    const double choice = candidate.connection_rays > 0.0 ? estimate * pairs
                          : own                           ? 0.0
                                                          : shared_choice;
    return cost(camera_path, segments, next_event) + light_paths_of_sample +
           candidate.light_paths * (light + (own ? 0.0 : shared_light_path)) +
           candidate.connections * choice +
           (candidate.connection_rays > 0.0 ? chosen_connection : connection) * connection_rays;
}

}  // namespace bdpt
