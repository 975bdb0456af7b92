#include "path/light_path_counts.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

LightPathCounts::LightPathCounts(const RenderOptions& options)
    : per_camera_path(options.bidirectional.light_paths)
{
    const bool whole = per_camera_path == std::floor(per_camera_path);
    connections = options.bidirectional.connections.value_or(whole ? per_camera_path : 1.0);
    rays = options.bidirectional.connection_rays;
    merged = options.integrator == IntegratorKind::vcm && per_camera_path > 0.0 &&
             options.bidirectional.merge_radius > 0.0;
    shared = merged ||
             (per_camera_path > 0.0 && (!whole || connections != per_camera_path || rays > 0.0));
    if (shared) {
        const double pixels =
            static_cast<double>(options.film.width) * static_cast<double>(options.film.height);
        bundle = std::max(1, static_cast<int>(std::ceil(connections)));
        bundles = std::max<std::int64_t>(1, std::llround(per_camera_path * pixels / bundle));
        per_camera_path = static_cast<double>(bundles) * bundle / pixels;
    }
}

}  // namespace bdpt
