#pragma once

#include "light/bounding_sphere.h"
#include "path/light_path_counts.h"

#include <bdpt/render_options.h>

#include <cstdint>

namespace bdpt {

/// How light and camera vertices merge in one sample index [Georgiev et al. 2012]: those closer
/// than `radius` count as one point. By default none does.
struct Merging {
    Merging() = default;
    /// As the options say for sample `index` of a scene in that sphere; they have been checked.
    Merging(const RenderOptions& options, const LightPathCounts& counts,
            const BoundingSphere& scene, std::int64_t index);

    float radius = 0.0f;       ///< [m]
    float light_paths = 0.0f;  ///< that each camera path may merge with

    /// Of the disk in which vertices merge [m^2].
    [[nodiscard]] float disk() const;
    /// What stands for the number of samples in the density of a path that merges: times the area
    /// density of light vertices at a point, it is how many of them are merged there [m^2].
    [[nodiscard]] double weight() const
    {
        return static_cast<double>(light_paths) * static_cast<double>(disk());
    }
};

}  // namespace bdpt
