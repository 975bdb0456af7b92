#pragma once

#include "path/sample_context.h"
#include "path/subpath.h"

#include <limits>

namespace bdpt {

/// Limits of a random walk.
struct WalkLimits {
    int max_vertices = 1;  ///< vertices of the subpath, including the lens or the light
    int rr_start = std::numeric_limits<int>::max();  ///< edges before Russian roulette
    /// Minimum survival probability of Russian roulette.
    float rr_survival = 0.0f;
};

/// Traces a camera subpath from the lens through `raster` into `path`; the first vertex is on the
/// lens, and the last may be on the environment at infinity.
void trace_camera_subpath(SampleContext& sample, Vec2 raster, const WalkLimits& limits,
                          Subpath& path);

/// Traces a light subpath from a randomly chosen light into `path`; the first vertex is on the
/// light. Records where the walk crosses the camera's finite lens. Empty if no light has power.
/// `sampling` is that of next-event estimation, whose density it stores.
void trace_light_subpath(SampleContext& sample, const WalkLimits& limits,
                         NextEventSampling sampling, Subpath& path);

}  // namespace bdpt
