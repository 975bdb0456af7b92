#pragma once

#include <bdpt/scene_desc.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// `light` without the pixels of an environment.
[[nodiscard]] LightDesc without_pixels(const LightDesc& light);

/// A light in a line for people.
[[nodiscard]] std::string light_text(const LightDesc& light);
/// The same as an object: "kind" and, by kind, what the light has.
[[nodiscard]] nlohmann::ordered_json light_json(const LightDesc& light);

}  // namespace bdpt::app
