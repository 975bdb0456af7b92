#pragma once

#include "light/light_samples.h"
#include "path/connect.h"
#include "path/strategy_set.h"

#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <span>

namespace bdpt {

/// Photon mapping as a strategy [Georgiev et al. 2012]: within a sample index, light vertices
/// (photons) closer to a camera vertex than `radius` merge with it. Disabled by default.
struct Merging {
    Merging() = default;
    /// Computes the merging of sample `index` of a scene with that bounding sphere from valid
    /// `options`.
    Merging(const RenderOptions& options, const LightPathCounts& counts,
            const BoundingSphere& scene, std::int64_t index);

    float radius = 0.0f;       ///< [m]
    float light_paths = 0.0f;  ///< light paths that each camera path may merge with

    /// Returns the area of the merge disk [m^2].
    [[nodiscard]] float disk() const;
    /// Returns the number of light paths times the area of the merge disk [m^2]: times the area
    /// density of light vertices at a point, it is the expected number of vertices that merge
    /// there.
    [[nodiscard]] double weight() const
    {
        return static_cast<double>(light_paths) * static_cast<double>(disk());
    }
};

/// Completes a path by merging: the last of at least two light vertices is identified with the last
/// of at least two camera vertices, at most `merging.radius` away. Takes `merging.light_paths`
/// samples per camera path.
[[nodiscard]] std::optional<Contribution> merge(std::span<const PathVertex> light,
                                                std::span<const PathVertex> camera,
                                                const Merging& merging, PathWeigher& weigher);

/// Tests whether camera vertex `z` can merge with light vertices.
[[nodiscard]] inline bool can_merge(const PathVertex& z)
{
    return z.kind == VertexKind::surface && z.connectible;
}

}  // namespace bdpt
