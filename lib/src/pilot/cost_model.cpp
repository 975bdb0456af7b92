#include "pilot/cost_model.h"

#include "pilot/path_shares.h"

namespace bdpt {
namespace {

/// Cost factors fitted to the CPU time of 48 scenes x 8 candidates, up to one factor per scene
/// (root mean square residual: 5 %). Only their ratios matter [ns].
struct CostModel {
    double sample;
    double segment;  ///< segment of a walk
    double shadow;   ///< shadow ray of a connection, with its BSDFs and weights
};
constexpr CostModel path_tracing{.sample = 20.0, .segment = 305.0, .shadow = 285.0};
constexpr CostModel camera_path{.sample = 140.0, .segment = 345.0, .shadow = 310.0};
constexpr CostModel light_path{.sample = 20.0, .segment = 400.0, .shadow = 205.0};
constexpr double connection = 200.0;         // its shadow ray
constexpr double shared_light_path = 150.0;  // to store it in memory
constexpr double shared_choice = 30.0;       // to fetch it from there

double cost(const CostModel& model, double segments, double shadow_rays)
{
    return model.sample + model.segment * segments + model.shadow * shadow_rays;
}

}  // namespace

double sample_cost(const Candidate& candidate, const RenderStats& pilot)
{
    const auto per = [](std::uint64_t count, std::uint64_t of) {
        return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of);
    };
    const RayCounts& rays = pilot.rays;
    const double segments = per(rays.camera, pilot.paths.camera);
    const double next_event =
        per(rays.shadow - rays.shadow_to_lens - rays.shadow_interior, pilot.paths.camera);
    if (candidate.light_paths == 0.0) {
        return cost(path_tracing, segments, next_event);
    }
    const double light = cost(light_path, per(rays.light, pilot.paths.light),
                              per(rays.shadow_to_lens, pilot.paths.light));
    const double interior =
        connection * per(rays.shadow_interior, PathShares::pilot_connections * pilot.paths.camera);
    const bool own = candidate.light_paths == candidate.connections && candidate.light_paths >= 1.0;
    return cost(camera_path, segments, next_event) +
           candidate.light_paths * (light + (own ? 0.0 : shared_light_path)) +
           candidate.connections * (interior + (own ? 0.0 : shared_choice));
}

}  // namespace bdpt
