#pragma once

#include "geometry/embree.h"
#include "geometry/sphere.h"

#include <span>

namespace bdpt {

/// Creates a geometry of spheres; the caller releases it, and `spheres` must outlive it. Embree's
/// own spheres compute in float, which frays the outline of distant small ones, so these are a user
/// geometry. A ray's `id` names the sphere that it ignores.
[[nodiscard]] RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres);

}  // namespace bdpt
