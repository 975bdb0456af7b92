#pragma once

#include "geometry/ray.h"
#include "math/side_media.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// One end of a segment of a path: what a ray that starts or ends there needs to know.
struct SegmentEnd {
    Vec3 p{0.0f};
    float error = 0.0f;  ///< how far off p can be, and the surface that a ray meets there [m]
    Vec3 ng{0.0f};       ///< unit geometric normal on the front; zero when on no surface
    std::uint32_t sphere = no_sphere;  ///< that p lies on; segments touch spheres from outside only
    SideMedia media{};                 ///< on both sides; around a point on no surface
};

}  // namespace bdpt
