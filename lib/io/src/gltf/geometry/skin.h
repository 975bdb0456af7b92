#pragma once

#include "file/load_context.h"
#include "gltf/animation/node_motion.h"
#include "gltf/animation/node_transforms.h"
#include "gltf/geometry/primitive_reader.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace bdpt::io {

/// Returns world from bind pose for each joint of a skin, at a step of the motion: the joint's
/// world transform times its inverse bind matrix [glTF 2.0, sec. 3.7.3]. Throws `Error`
/// (invalid_input).
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, int skin,
                                                     NodeTransforms& transforms,
                                                     const NodeMotion& motion, std::size_t step,
                                                     LoadContext& context);

/// Tests whether any joint of the skin moves.
[[nodiscard]] bool moves(const tinygltf::Skin& skin, const NodeMotion& motion);

/// Applies a skin to a mesh, which is in world space afterwards; all sets JOINTS_n and WEIGHTS_n
/// count. Weights are normalized to a sum of one. Parts that the joints mirror keep their front.
/// Does nothing without joints. Throws `Error` (invalid_input) for a joint that does not exist.
void apply_skin(MeshDesc& mesh, const PrimitiveReader& primitive,
                std::span<const glm::dmat4> joints, LoadContext& context);

/// Tests whether the primitive has the joint attributes of a skin.
[[nodiscard]] bool has_joints(const PrimitiveReader& primitive);

}  // namespace bdpt::io
