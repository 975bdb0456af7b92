#pragma once

#include "geometry/ray.h"
#include "math/side_media.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// One end of a segment of a path, with the data needed to trace a ray from or to it.
struct SegmentEnd {
    Vec3 p{0.0f};
    float error = 0.0f;  ///< bound of the error of p and of the surface hit there [m]
    Vec3 ng{0.0f};       ///< unit geometric normal on the front; zero if not on a surface
    /// Sphere that contains p; segments touch spheres from outside only.
    std::uint32_t sphere = no_sphere;
    /// Media on both sides, or around a point that is not on a surface.
    SideMedia media{};
};

}  // namespace bdpt
