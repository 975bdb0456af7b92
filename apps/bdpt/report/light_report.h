#pragma once

#include <bdpt/scene_desc.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// Returns `light` without the pixels of an environment.
[[nodiscard]] LightDesc without_pixels(const LightDesc& light);

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

/// Returns a light as a line for people.
[[nodiscard]] std::string light_text(const LightDesc& light, const DVec3& origin);
/// Returns a light as an object: "kind" and its properties by kind.
[[nodiscard]] nlohmann::ordered_json light_json(const LightDesc& light, const DVec3& origin);

}  // namespace bdpt::app
