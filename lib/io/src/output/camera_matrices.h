#pragma once

#include <bdpt/scene_desc.h>

namespace bdpt::io {

/// Returns world to the camera space of OpenEXR's attribute "worldToCamera": left-handed, +x right,
/// +y up, +z into the image [OpenEXR standard attributes].
[[nodiscard]] Mat4 camera_from_world(const CameraDesc& camera);

/// Returns world to the space of OpenEXR's attribute "worldToNDC": after the division by w, (0, 0)
/// is the upper left corner of the image and (1, 1) the lower right one. `aspect` is width over
/// height.
[[nodiscard]] Mat4 ndc_from_world(const CameraDesc& camera, float aspect);

}  // namespace bdpt::io
