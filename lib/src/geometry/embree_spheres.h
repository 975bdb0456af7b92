#pragma once

#include "geometry/embree.h"
#include "geometry/sphere.h"

#include <span>

namespace bdpt {

/// A geometry of spheres; the caller releases it, and `spheres` must outlive it. Embree's own
/// spheres compute in float, which frays the outline of those that are small as seen from afar, so
/// these are of the user's kind. A ray's `id` names the sphere that it does not see.
[[nodiscard]] RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres);

}  // namespace bdpt
