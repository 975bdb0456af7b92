#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <optional>

namespace bdpt::app {

/// The point around which a camera goes: `look_at` or, without it, where its view axis is nearest
/// to the `middle` of the scene [m]. Throws `Error` (usage) when that is not in front of it.
[[nodiscard]] Vec3 orbit_center(const CameraDesc& camera, const std::optional<Vec3>& look_at,
                                Vec3 middle);

}  // namespace bdpt::app
