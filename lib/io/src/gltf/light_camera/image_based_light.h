#pragma once

#include "file/load_context.h"
#include "gltf/document/model.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <optional>

namespace bdpt::io {

/// Reads the environment of a scene [EXT_lights_image_based], from the first level of its cube;
/// none, with a warning, if an image of it cannot be read. Throws `Error` (invalid_input) for a
/// cube that lacks a side, or is beyond the limits.
[[nodiscard]] std::optional<EnvironmentLightDesc> read_image_based_light(
    const tinygltf::Model& model, std::size_t scene, LoadContext& context);

}  // namespace bdpt::io
