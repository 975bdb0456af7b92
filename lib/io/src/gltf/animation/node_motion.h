#pragma once

#include "file/load_context.h"
#include "gltf/animation/animation.h"

#include <bdpt/io/gltf.h>
#include <bdpt/types.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace bdpt::io {

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

}  // namespace bdpt::io
