#include "path/merging.h"

#include "math/elementary.h"
#include "path/path_vertex.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

Merging::Merging(const RenderOptions& options, const LightPathCounts& counts,
                 const BoundingSphere& scene, std::int64_t index)
{
    if (!counts.merged) {
        return;
    }
    // Below these values positions lose all digits, or squared distances underflow.
    const float least = std::max(1e-7f * scene.radius, std::sqrt(coincident));
    const float exponent = 0.5f * (static_cast<float>(options.bidirectional.merge_alpha) - 1.0f);
    const float first = static_cast<float>(options.bidirectional.merge_radius) * scene.radius;
    radius =
        std::max(least, first * exp_exact(exponent * log_exact(static_cast<float>(index + 1))));
    light_paths = static_cast<float>(counts.bundles * counts.bundle);
}

float Merging::disk() const
{
    return pi * radius * radius;
}

}  // namespace bdpt
