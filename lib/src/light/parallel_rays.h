#pragma once

#include "light/bounding_sphere.h"
#include "math/frame.h"
#include "math/warp.h"

namespace bdpt {

/// Samples the entry point of a ray of direction `direction` into the scene: uniform on the disk in
/// front of it.
[[nodiscard]] inline Vec3 sample_entry(const BoundingSphere& bounds, Vec3 direction, Vec2 u)
{
    const Vec2 on_disk = bounds.radius * square_to_disk(u);
    const Frame frame = Frame::from_normal(direction);
    return bounds.center + on_disk.x * frame.x + on_disk.y * frame.y - bounds.radius * direction;
}

}  // namespace bdpt
