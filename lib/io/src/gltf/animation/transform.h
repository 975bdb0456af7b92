#pragma once

#include "file/load_context.h"
#include "gltf/document/tinygltf.h"

#include <bdpt/types.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::io {

/// The node's own transform, from its matrix or its translation, rotation and scale [glTF 2.0,
/// sec. 3.5.3]. Affine; in double, so that deep hierarchies lose nothing.
[[nodiscard]] glm::dmat4 local_transform(const tinygltf::Model& model, std::size_t node,
                                         LoadContext& context);

/// A direction [not zero] of the node's space in world space, of unit length; (0, 0, -1) where the
/// transform leaves none.
[[nodiscard]] Vec3 transform_direction(const glm::dmat4& world_from_node,
                                       const glm::dvec3& direction);

/// The rotation of a quaternion (x, y, z, w); of unit length or made so, with a warning.
[[nodiscard]] glm::dmat4 rotation(const std::vector<double>& xyzw, const std::string& place,
                                  LoadContext& context);

/// What is left of a transform without scale and shear: orthonormal axes. -z points where the
/// transform takes it and x as near as it can; it mirrors if the transform does.
[[nodiscard]] Mat3 axes_of(const glm::dmat4& world_from_node);

/// Are all elements finite?
[[nodiscard]] bool is_finite(const Mat4& matrix);

/// By how much the transform scales lengths: the geometric mean over all axes.
[[nodiscard]] double mean_scale(const glm::dmat4& world_from_node);

}  // namespace bdpt::io
