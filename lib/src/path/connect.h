#pragma once

#include "path/densities.h"
#include "path/path_vertex.h"

#include <bdpt/render_stats.h>

#include <optional>

namespace bdpt {

class Camera;
class Sampler;

// Joins that test visibility count their rays in `rays`; the key is that of their segment
// (`Sampler::segment_key`). There are joins for all probes of math/probe.h: they begin in
// Phase::connect, and one that finds something ends in Phase::weigh.

/// What one strategy found.
struct Contribution {
    Rgb unweighted{0.0f};
    float weight = 0.0f;  ///< by MIS
};

/// The same for the strategies whose pixel is not known beforehand.
struct Splat {
    Contribution contribution;
    Vec2 raster{0.0f};
};

/// s = 0: the camera subpath of at least two vertices ends on a light by chance.
template <typename Probe>
[[nodiscard]] std::optional<Contribution> hit_light(const World& world,
                                                    std::span<const PathVertex> camera,
                                                    PathWeigher& weigher, Probe& probe);

/// s = 1: next-event estimation from the last of at least two camera vertices to a fresh point of a
/// light.
template <typename Probe>
[[nodiscard]] std::optional<Contribution> connect_to_light(const World& world,
                                                           std::span<const PathVertex> camera,
                                                           Sampler& sampler, PathWeigher& weigher,
                                                           RayCounts& rays, Probe& probe);

/// s = t = 1: a fresh point of a light is seen through a fresh point of the lens.
template <typename Probe>
[[nodiscard]] std::optional<Splat> connect_light_to_lens(const World& world, const Camera& camera,
                                                         Sampler& sampler, PathWeigher& weigher,
                                                         RayCounts& rays, Probe& probe);

/// t = 1, s >= 2: the last of at least two light vertices is seen through a fresh point of the
/// lens.
template <typename Probe>
[[nodiscard]] std::optional<Splat> connect_to_lens(const World& world, const Camera& camera,
                                                   std::span<const PathVertex> light,
                                                   Sampler& sampler, PathWeigher& weigher,
                                                   RayCounts& rays, Probe& probe);

/// t = 0: the light subpath crosses the lens by chance.
template <typename Probe>
[[nodiscard]] std::optional<Splat> hit_lens(const World& world, const Subpath& light_path,
                                            const LensCrossing& crossing, PathWeigher& weigher,
                                            Probe& probe);

/// s >= 2, t >= 2: the last vertices of both subpaths see each other.
template <typename Probe>
[[nodiscard]] std::optional<Contribution> connect_interior(const World& world,
                                                           std::span<const PathVertex> light,
                                                           std::span<const PathVertex> camera,
                                                           SegmentKey segment, PathWeigher& weigher,
                                                           RayCounts& rays, Probe& probe);

}  // namespace bdpt
