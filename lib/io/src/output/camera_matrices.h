#pragma once

#include <bdpt/scene_desc.h>

namespace bdpt::io {

// `origin` is that of the world, which cameras are in, in the coordinates of the file
// (`SceneDesc::origin`), which are the world of other programs.

/// Returns the file's coordinates to the camera space of OpenEXR's attribute "worldToCamera":
/// left-handed, +x right, +y up, +z into the image [OpenEXR standard attributes].
[[nodiscard]] Mat4 camera_from_file(const CameraDesc& camera, const DVec3& origin);

/// Returns the file's coordinates to the space of OpenEXR's attribute "worldToNDC": after the
/// division by w, (0, 0) is the upper left corner of the image and (1, 1) the lower right one.
/// `aspect` is width over height.
[[nodiscard]] Mat4 ndc_from_file(const CameraDesc& camera, const DVec3& origin, float aspect);

}  // namespace bdpt::io
