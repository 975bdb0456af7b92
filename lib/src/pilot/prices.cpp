#include "pilot/prices.h"

namespace bdpt {
namespace {

/// Fitted to the CPU time of 14 scenes x 7 candidates, up to a factor of each scene (root mean
/// square of what is left: 6 %). Only their ratios matter [ns].
struct Prices {
    double sample;
    double segment;  ///< of a walk
    double shadow;   ///< ray of a join, with its BSDFs and weights
};
constexpr Prices path_tracing{.sample = 300.0, .segment = 254.0, .shadow = 105.0};
constexpr Prices camera_path{.sample = 346.0, .segment = 329.0, .shadow = 176.0};
constexpr Prices light_path{.sample = 223.0, .segment = 163.0, .shadow = 414.0};
constexpr double connection = 156.0;        // its shadow ray
constexpr double shared_light_path = 82.0;  // to keep it in memory
constexpr double shared_choice = 132.0;     // to get it from there

double price(const Prices& prices, double segments, double shadow_rays)
{
    return prices.sample + prices.segment * segments + prices.shadow * shadow_rays;
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
        return price(path_tracing, segments, next_event);
    }
    const double light = price(light_path, per(rays.light, pilot.paths.light),
                               per(rays.shadow_to_lens, pilot.paths.light));
    const double interior = connection * per(rays.shadow_interior, pilot.paths.light);
    const bool own = candidate.light_paths == candidate.connections && candidate.light_paths >= 1.0;
    return price(camera_path, segments, next_event) +
           candidate.light_paths * (light + (own ? 0.0 : shared_light_path)) +
           candidate.connections * (interior + (own ? 0.0 : shared_choice));
}

}  // namespace bdpt
