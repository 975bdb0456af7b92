#pragma once

#include "path/path_vertex.h"

namespace bdpt {

class Camera;
class Sampler;

/// Fills `path` from the lens through `raster` with up to `max_vertices` vertices; the first is on
/// the lens, and the last may be at infinity on the environment.
void trace_camera_subpath(const World& world, const Camera& camera, Vec2 raster, int max_vertices,
                          Sampler& sampler, Subpath& path);

/// Fills `path` from a randomly chosen light with up to `max_vertices` vertices, the first on the
/// light. Empty when no light has power.
void trace_light_subpath(const World& world, int max_vertices, Sampler& sampler, Subpath& path);

}  // namespace bdpt
