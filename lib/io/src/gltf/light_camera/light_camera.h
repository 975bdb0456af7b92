#pragma once

#include <bdpt/scene_desc.h>
#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "file/load_context.h"
#include "gltf/document/document.h"

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

// `worlds`: transforms of node `node` at equally spaced times while the shutter is open, the first
// at its opening; empty: it stands still. A motion that cannot be linear, such as a jump, is
// dropped with a warning.

/// Returns `CameraDesc::motion`.
[[nodiscard]] std::vector<Mat4> camera_motion(std::span<const glm::dmat4> worlds, std::size_t node,
                                              LoadContext& context);

/// Makes a light that was read for the opening move with its node.
void move_light(LightDesc& light, std::span<const glm::dmat4> worlds, std::size_t node,
                LoadContext& context);

/// Returns the pose of a camera in its node: upside down if both extents are negative.
[[nodiscard]] glm::dmat4 node_from_camera(const tinygltf::Camera& camera);

/// Reads the camera of a node; none if it has none, or, with a warning, one that cannot be
/// rendered.
[[nodiscard]] std::optional<CameraDesc> read_camera(const tinygltf::Model& model, std::size_t node,
                                                    const glm::dmat4& world_from_node,
                                                    LoadContext& context);

/// Reads the KHR_lights_punctual light of a node, if any. Units are those of the extension: candela
/// and lux; `extras.radius` [m] of a point or spot light is scaled by the node's mean scale. Throws
/// `Error` (unsupported) for an unknown type.
[[nodiscard]] std::optional<LightDesc> read_light(const tinygltf::Model& model, std::size_t node,
                                                  const glm::dmat4& world_from_node,
                                                  LoadContext& context);

/// Reads the light profiles of a document [EXT_lights_ies], each when a node first uses it.
class LightProfiles {
public:
    /// The arguments must outlive this object. Profiles are added to `profiles`.
    LightProfiles(const tinygltf::Model& model, std::vector<LightProfile>& profiles,
                  LoadContext& context)
        : model_(model), profiles_(profiles), context_(context)
    {}

    /// Reads the light of a node, if any. Throws `Error`: not_found for a missing file,
    /// invalid_input for a broken one.
    [[nodiscard]] std::optional<LightDesc> read(std::size_t node,
                                                const glm::dmat4& world_from_node);

private:
    /// A profile that has been read: its id, and its axes in the node's space.
    struct Known {
        ProfileId id{};
        Mat3 node_from_profile{1.0f};
    };
    [[nodiscard]] const Known& get(std::size_t index);

    const tinygltf::Model& model_;
    std::vector<LightProfile>& profiles_;
    LoadContext& context_;
    std::map<std::size_t, Known> known_;
};

/// Reads the environment of a scene [EXT_lights_image_based], from the first level of its cube;
/// none, with a warning, if an image of it cannot be read. Throws `Error` (invalid_input) for a
/// cube that lacks a side, or is beyond the limits.
[[nodiscard]] std::optional<EnvironmentLightDesc> read_image_based_light(
    const tinygltf::Model& model, std::size_t scene, LoadContext& context);

}  // namespace bdpt::io
