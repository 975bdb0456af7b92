#pragma once

#include "file/load_context.h"
#include "gltf/animation/keyframes.h"
#include "gltf/document/model.h"

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace bdpt::io {

/// Selects the animations of a file that play, by index; none: nodes rest as in the file. `names`
/// are those of all its animations. Throws `Error` (not_found, usage).
[[nodiscard]] std::vector<std::size_t> select_animations(const std::vector<std::string>& names,
                                                         const GltfOptions& options,
                                                         LoadContext& context);

/// An animated property of a node (translation, rotation, scale or weights of morph targets) with
/// its key frames.
struct AnimatedProperty {
    std::size_t node = 0;
    std::vector<double> tinygltf::Node::*member = nullptr;
    Quantity quantity = Quantity::numbers;
    KeyFrames frames{};
};

/// Reads the properties that an animation moves; it must be one that plays (build_model). Throws
/// `Error` (invalid_input) for invalid key frames.
[[nodiscard]] std::vector<AnimatedProperty> read_animation(const tinygltf::Model& model,
                                                           std::size_t index, LoadContext& context);

/// Poses the nodes at a time [s]; if a property occurs twice, the last one wins.
void pose(tinygltf::Model& model, std::span<const AnimatedProperty> properties, double time);

}  // namespace bdpt::io
