#pragma once

#include "path/sample_context.h"
#include "path/subpath.h"

#include <limits>

namespace bdpt {

/// The limits of a random walk.
struct WalkLimits {
    int max_vertices = 1;  ///< of the subpath, the lens or the light included
    int rr_start = std::numeric_limits<int>::max();  ///< edges before Russian roulette
    float rr_survival = 0.0f;                        ///< its least probability of going on
};

// Walks begin and end in Phase::walk.

/// Fills `path` from the lens through `raster`; the first vertex is on the lens, and the last may
/// be at infinity on the environment.
void trace_camera_subpath(SampleContext& sample, Vec2 raster, const WalkLimits& limits,
                          Subpath& path);

/// Fills `path` from a randomly chosen light; the first vertex is on the light. Records where the
/// walk crosses the camera's finite lens. Empty when no light has power. `sampling` is that of
/// next-event estimation, whose density it notes.
void trace_light_subpath(SampleContext& sample, const WalkLimits& limits,
                         NextEventSampling sampling, Subpath& path);

}  // namespace bdpt
