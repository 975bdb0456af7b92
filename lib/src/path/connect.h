#pragma once

#include "path/path_weigher.h"
#include "path/sample_context.h"
#include "path/subpath.h"

#include <optional>
#include <span>

namespace bdpt {

// Five ways to complete a path; lens_crossing.h and merge.h have two more. They begin in
// Phase::connect, and one that finds something ends in Phase::weigh.

/// The contribution of one strategy to one path.
struct Contribution {
    Rgb unweighted{0.0f};
    float weight = 1.0f;     ///< by MIS
    bool dispersed = false;  ///< a vertex of the path disperses
    Vec2 raster{0.0f};       ///< where on the film, of t <= 1
};

/// s = 0: the camera subpath of at least two vertices ends on a light by chance.
[[nodiscard]] std::optional<Contribution> hit_light(const SampleContext& sample,
                                                    std::span<const PathVertex> camera,
                                                    PathWeigher& weigher);

/// The random point of the first light sample after `t` camera vertices.
[[nodiscard]] Vec2 first_light_sample(SampleContext& sample, int t);

/// s = 1: next-event estimation from the last of at least two camera vertices to a fresh point of a
/// light, chosen by the random point `u`.
[[nodiscard]] std::optional<Contribution> connect_to_light(SampleContext& sample,
                                                           std::span<const PathVertex> camera,
                                                           Vec2 u, PathWeigher& weigher);

/// s = t = 1: a fresh point of a light is seen through a fresh point of the lens.
[[nodiscard]] std::optional<Contribution> connect_light_to_lens(SampleContext& sample,
                                                                PathWeigher& weigher);

/// t = 1, s >= 2: the last of at least two light vertices is seen through a fresh point of the
/// lens.
[[nodiscard]] std::optional<Contribution> connect_to_lens(SampleContext& sample,
                                                          std::span<const PathVertex> light,
                                                          PathWeigher& weigher);

/// s >= 2, t >= 2: the last vertices of both subpaths see each other.
[[nodiscard]] std::optional<Contribution> connect_interior(const SampleContext& sample,
                                                           std::span<const PathVertex> light,
                                                           std::span<const PathVertex> camera,
                                                           PathWeigher& weigher);

}  // namespace bdpt
