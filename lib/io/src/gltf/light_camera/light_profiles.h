#pragma once

#include "file/load_context.h"
#include "gltf/document/model.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace bdpt::io {

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

}  // namespace bdpt::io
