#pragma once

#include "material/material.h"
#include "scene/light_set.h"

#include <bdpt/image.h>
#include <bdpt/scene.h>
#include <bdpt/shared_scene_desc.h>

#include <span>
#include <string>
#include <vector>

namespace bdpt {

struct SceneGeometry;

/// Throws `Error` (invalid_input) for the first invalid value in `desc`: an index out of range, a
/// number that is not finite or outside of its range, a transform without an inverse. The message
/// names the item and the value. `valid` is a valid description: lists that both share are not
/// checked again.
void validate(const SharedSceneDesc& desc, const SharedSceneDesc& valid = {});

/// Counts a valid description, excluding lights.
[[nodiscard]] SceneCounts count(const SharedSceneDesc& desc);

/// Throws `Error` (invalid_input) for the first invalid value of the lights and their profiles.
/// `reach` is the maximum distance of lights from the origin [m].
void validate_lights(const SharedSceneDesc& desc, float reach);

/// Returns the end of a message that states the distance limit and its reason.
[[nodiscard]] std::string limit_text(float reach);

/// Checks everything that moves in a scene that is valid when the shutter opens; `reach` as in
/// geometry/placed_mesh.h, and lights only if the positions of meshes are known to be valid.
/// Throws `Error` (invalid_input).
void check_motion(const SharedSceneDesc& desc, float reach, bool places_are_valid);

/// Throws `Error` (invalid_input) that names the first light whose power is more than
/// `max_light_power`. The other arguments are those of the valid description `desc`.
void check_powers(const SharedSceneDesc& desc, std::span<const MaterialId> material_ids,
                  std::span<const Material> materials, const LightSet& lights);

/// Throws `Error` (invalid_input) whose message begins with `item` if the image has no texels, a
/// wrong number of bytes, or values that textures cannot have.
void check_texels(const TexelImage& image, const std::string& item);

/// Returns warnings about insufficient single precision in a valid scene, one line each: meshes
/// that are small relative to their distance from the origin, and lights that are too near to a
/// vast plane. `geometry` fits `desc`.
[[nodiscard]] std::vector<std::string> precision_warnings(const SharedSceneDesc& desc,
                                                          const SceneGeometry& geometry);

}  // namespace bdpt
