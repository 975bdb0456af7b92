#pragma once

#include "file/load_context.h"

#include <bdpt/types.h>

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::io {

/// Returns the node's local transform, from its matrix or its translation, rotation and scale [glTF
/// 2.0, sec. 3.5.3]. Affine; in double, so that deep hierarchies lose no precision.
[[nodiscard]] glm::dmat4 local_transform(const tinygltf::Model& model, std::size_t node,
                                         LoadContext& context);

/// Transforms a direction (not zero) from the node's space to world space, with unit length; (0, 0,
/// -1) if the transform maps it to zero.
[[nodiscard]] Vec3 transform_direction(const glm::dmat4& world_from_node,
                                       const glm::dvec3& direction);

/// Returns the rotation of a quaternion (x, y, z, w), which is normalized if need be, with a
/// warning.
[[nodiscard]] glm::dmat4 rotation(const std::vector<double>& xyzw, const std::string& place,
                                  LoadContext& context);

/// Removes scale and shear from a transform: returns orthonormal axes. -z points where the
/// transform maps it and x as near as possible; mirrors if the transform does.
[[nodiscard]] Mat3 compute_axes(const glm::dmat4& world_from_node);

/// Tests whether all elements are finite.
[[nodiscard]] bool is_finite(const Mat4& matrix);

/// Returns the factor by which the transform scales lengths: the geometric mean over all axes.
[[nodiscard]] double mean_scale(const glm::dmat4& world_from_node);

}  // namespace bdpt::io
