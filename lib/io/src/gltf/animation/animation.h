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

/// Which animations of a file play, by index; none: nodes rest as the file has them. `names` are
/// those of all its animations. Throws `Error` (not_found, usage).
[[nodiscard]] std::vector<std::size_t> select_animations(const std::vector<std::string>& names,
                                                         const GltfOptions& options,
                                                         LoadContext& context);

/// A property of a node, its translation, rotation, scale or weights of morph targets, and what
/// moves it.
struct AnimatedProperty {
    std::size_t node = 0;
    std::vector<double> tinygltf::Node::*member = nullptr;
    Quantity quantity = Quantity::numbers;
    KeyFrames frames{};
};

/// All that an animation moves, which must be one that plays (build_model). Throws `Error`
/// (invalid_input) for key frames that make no sense.
[[nodiscard]] std::vector<AnimatedProperty> read_animation(const tinygltf::Model& model,
                                                           std::size_t index, LoadContext& context);

/// Puts the nodes where they are at a time [s]; where two properties are the same the last decides.
void pose(tinygltf::Model& model, std::span<const AnimatedProperty> properties, double time);

}  // namespace bdpt::io
