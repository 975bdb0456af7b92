#pragma once

#include "file/load_context.h"
#include "gltf/document/tinygltf.h"

#include <bdpt/scene_desc.h>

#include <string>

namespace bdpt::io {

/// Is it above 0 and finite as a float too?
[[nodiscard]] bool is_length(double value);

/// A camera's thin lens [m]; names and values as in `CameraDesc`.
struct Lens {
    float radius = CameraDesc{}.lens_radius;
    float focus_distance = CameraDesc{}.focus_distance;
};

/// What `extras` of the camera at `place` says by lensRadius [m] or fStop, and focusDistance [m].
/// Extras belong to whoever writes them, so a value that makes no sense is no error: it is ignored
/// with a warning.
[[nodiscard]] Lens read_lens(const tinygltf::Camera& camera, const CameraDesc& desc,
                             const std::string& place, LoadContext& context);

}  // namespace bdpt::io
