#pragma once

#include "path/path_weigher.h"
#include "path/random_walk.h"
#include "path/sample_context.h"
#include "path/subpath.h"

#include <optional>
#include <span>

namespace bdpt {

// Six techniques that complete a path; merge.h has one more.

/// The contribution of one strategy to one path.
struct Contribution {
    Rgb unweighted{0.0f};
    float weight = 1.0f;     ///< MIS weight
    float chance = 1.0f;     ///< expected number of times that the connection or merge is chosen
    bool dispersed = false;  ///< true if a vertex of the path disperses
    Vec2 raster{0.0f};       ///< position on the film, for t <= 1
};

/// Connects with s = 0: the camera subpath of at least two vertices hits a light.
[[nodiscard]] std::optional<Contribution> hit_light(const SampleContext& sample,
                                                    std::span<const PathVertex> camera,
                                                    PathWeigher& weigher);

/// Draws the random point of the first light sample after `t` camera vertices.
[[nodiscard]] Vec2 first_light_sample(SampleContext& sample, int t);

/// Connects with s = 1: next-event estimation from the last of at least two camera vertices to a
/// new point on a light, chosen by the random point `u`.
[[nodiscard]] std::optional<Contribution> connect_to_light(SampleContext& sample,
                                                           std::span<const PathVertex> camera,
                                                           Vec2 u, PathWeigher& weigher);

/// Connects with s = t = 1: a new point on a light to a new point on the lens.
[[nodiscard]] std::optional<Contribution> connect_light_to_lens(SampleContext& sample,
                                                                PathWeigher& weigher);

/// Connects with t = 1, s >= 2: the last of at least two light vertices to a new point on the lens.
[[nodiscard]] std::optional<Contribution> connect_to_lens(SampleContext& sample,
                                                          std::span<const PathVertex> light,
                                                          PathWeigher& weigher);

/// Connects with s >= 2, t >= 2: the last vertices of both subpaths.
[[nodiscard]] std::optional<Contribution> connect_interior(const SampleContext& sample,
                                                           std::span<const PathVertex> light,
                                                           std::span<const PathVertex> camera,
                                                           PathWeigher& weigher);

/// Records in `path` whether `step`, which ends after `free_distance` [m], crosses the lens before.
/// `segment` is the key of the walk's segment.
void look_for_lens(const SampleContext& sample, const WalkStep& step, float free_distance,
                   SegmentKey segment, Subpath& path);

/// Connects with t = 0: the light subpath crosses a finite aperture by chance; the aperture does
/// not block it.
[[nodiscard]] std::optional<Contribution> hit_lens(const SampleContext& sample,
                                                   const Subpath& light_path,
                                                   const LensCrossing& crossing,
                                                   PathWeigher& weigher);

}  // namespace bdpt
