#pragma once

#include "light/bounding_sphere.h"
#include "path/light_path_counts.h"

#include <bdpt/render_options.h>

#include <cstdint>

namespace bdpt {

/// Photon mapping as a strategy [Georgiev et al. 2012]: in one sample index, light vertices
/// (photons) closer to a camera vertex than `radius` merge with it. By default none does.
struct Merging {
    Merging() = default;
    /// As the options say for sample `index` of a scene in that sphere; they have been checked.
    Merging(const RenderOptions& options, const LightPathCounts& counts,
            const BoundingSphere& scene, std::int64_t index);

    float radius = 0.0f;       ///< [m]
    float light_paths = 0.0f;  ///< that each camera path may merge with

    /// Area of the disk in which vertices merge [m^2].
    [[nodiscard]] float disk() const;
    /// The number of light paths times the area of the merge disk [m^2]: times the area density of
    /// light vertices at a point, it is the expected number of vertices that merge there.
    [[nodiscard]] double weight() const
    {
        return static_cast<double>(light_paths) * static_cast<double>(disk());
    }
};

}  // namespace bdpt
