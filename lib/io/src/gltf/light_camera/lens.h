#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <tiny_gltf.h>

#include <string>

namespace bdpt::io {

/// Tests whether `value` is above 0 and finite, also as a float.
[[nodiscard]] bool is_length(double value);

/// A camera's thin lens [m]; names and values as in `CameraDesc`.
struct Lens {
    float radius = CameraDesc{}.lens_radius;
    float focus_distance = CameraDesc{}.focus_distance;
};

/// Reads a lens from `extras` of the camera at `place`: lensRadius [m] or fStop, and focusDistance
/// [m]. Extras are free-form, so an invalid value is no error: it is ignored with a warning.
[[nodiscard]] Lens read_lens(const tinygltf::Camera& camera, const CameraDesc& desc,
                             const std::string& place, LoadContext& context);

}  // namespace bdpt::io
