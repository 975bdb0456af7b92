#pragma once

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

namespace bdpt::app {

/// Returns the share of the image that surfaces fill, in [0, 1]. `aspect` is width over height.
/// Throws `Error` for a camera that is too far away to render.
[[nodiscard]] double filled_share(const Scene& scene, const CameraDesc& camera, float aspect);

}  // namespace bdpt::app
