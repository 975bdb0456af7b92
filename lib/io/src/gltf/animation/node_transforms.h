#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/types.h>
#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "file/load_context.h"
#include "gltf/animation/animation.h"

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

/// World transforms of all nodes, computed on demand.
class NodeTransforms {
public:
    /// The arguments must outlive this object. The nodes must be a forest (check_node_graph).
    /// `origin`: the world's origin in the coordinates of the file.
    NodeTransforms(const tinygltf::Model& model, const DVec3& origin, LoadContext& context);

    /// Returns node space to world space. Throws `Error` (invalid_input) if it is not finite.
    [[nodiscard]] const glm::dmat4& world(std::size_t node);

private:
    const tinygltf::Model& model_;
    DVec3 origin_;
    LoadContext& context_;
    std::vector<std::size_t> parents_;
    std::vector<std::optional<glm::dmat4>> world_;
};

/// Transforms and morph-target weights of nodes at equally spaced times while the shutter is open.
/// The number of steps is a power of two of up to 64, just large enough that linear interpolation
/// is close to all that moves (gltf/animation/steps.h).
class NodeMotion {
public:
    /// Creates a motion in which nothing moves.
    NodeMotion() = default;
    /// Samples the animations. Leaves the model in its pose at the opening. `open` and `close` [s]
    /// are times of the animation. Throws `Error` (invalid_input).
    NodeMotion(tinygltf::Model& model, std::span<const AnimatedProperty> properties, double open,
               double close, LoadContext& context);

    /// Moves the world's origin, given in the coordinates of the file; it was there.
    void set_origin(const DVec3& origin);

    /// Returns the number of steps after the opening; 0: nothing moves.
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// Returns node space to world space at `steps()` + 1 times; empty: the node stands still.
    [[nodiscard]] std::span<const glm::dmat4> world(std::size_t node) const;
    /// Returns the weights of morph targets at `steps()` + 1 times; empty: they are constant.
    [[nodiscard]] std::span<const std::vector<double>> weights(std::size_t node) const;

private:
    std::size_t steps_ = 0;
    std::map<std::size_t, std::vector<glm::dmat4>> world_;
    std::map<std::size_t, std::vector<std::vector<double>>> weights_;
};

/// Returns the transforms of the instances of a node's mesh by EXT_mesh_gpu_instancing, in the
/// node's space; the identity alone without the extension. Throws `Error` (invalid_input), also for
/// more than `most` instances, before any is read.
[[nodiscard]] std::vector<glm::dmat4> instance_transforms(const tinygltf::Model& model,
                                                          std::size_t node, std::size_t most,
                                                          LoadContext& context);

}  // namespace bdpt::io
