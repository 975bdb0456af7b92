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

/// World from bind pose for each joint of a skin, at a step of the motion: the joint's world
/// transform times its inverse bind matrix [glTF 2.0, sec. 3.7.3]. Throws `Error` (invalid_input).
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, int skin,
                                                     NodeTransforms& transforms,
                                                     const NodeMotion& motion, std::size_t step,
                                                     LoadContext& context);

/// Does any joint of the skin move?
[[nodiscard]] bool moves(const tinygltf::Skin& skin, const NodeMotion& motion);

/// Moves a mesh to where its joints take it, which is world space; all sets JOINTS_n and WEIGHTS_n
/// count. Weights are made to add up to one. Parts that the joints mirror keep their front. Does
/// nothing for no joints. Throws `Error` (invalid_input) for a joint that there is not.
void apply_skin(MeshDesc& mesh, const PrimitiveReader& primitive,
                std::span<const glm::dmat4> joints, LoadContext& context);

/// Can the primitive be skinned: does it say which joints move its vertices?
[[nodiscard]] bool has_joints(const PrimitiveReader& primitive);

}  // namespace bdpt::io
