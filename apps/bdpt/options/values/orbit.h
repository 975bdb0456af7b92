#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <optional>

namespace bdpt::app {

/// Returns the point that a camera orbits: `look_at` or, without it, the point of its view axis
/// nearest to the `middle` of the scene [m]. Throws `Error` (usage) if it is not in front of the
/// camera.
[[nodiscard]] Vec3 orbit_center(const CameraDesc& camera, const std::optional<Vec3>& look_at,
                                Vec3 middle);

}  // namespace bdpt::app
