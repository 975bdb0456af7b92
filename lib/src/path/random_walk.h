#pragma once

#include "path/path_vertex.h"

#include <limits>

namespace bdpt {

class Camera;
class Sampler;

// Walks are there for all probes of math/probe.h; they begin and end in Phase::walk.

/// What limits a walk.
struct WalkLimits {
    int max_vertices = 1;  ///< of the subpath, the lens or the light included
    int rr_start = std::numeric_limits<int>::max();  ///< edges before Russian roulette
};

/// Fills `path` from the lens through `raster`; the first vertex is on the lens, and the last may
/// be at infinity on the environment.
template <typename Probe>
void trace_camera_subpath(const World& world, const Camera& camera, Vec2 raster,
                          const WalkLimits& limits, Sampler& sampler, Subpath& path, Probe& probe);

/// Fills `path` from a randomly chosen light; the first vertex is on the light. Records where the
/// walk crosses the camera's finite lens. Empty when no light has power. `sampling` is that of
/// next-event estimation, whose density it notes.
template <typename Probe>
void trace_light_subpath(const World& world, const Camera& camera, const WalkLimits& limits,
                         NextEventSampling sampling, Sampler& sampler, Subpath& path, Probe& probe);

}  // namespace bdpt
