#pragma once

#include "file/load_context.h"
#include "gltf/animation/animation.h"

#include <bdpt/io/gltf.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace bdpt::io {

/// Where nodes are, and how much of their morph targets shows, at equally spaced times while the
/// shutter is open: a power of two of steps, so many that straight lines from one to the next are
/// close to all that moves (gltf/animation/steps.h), but at most 64.
class NodeMotion {
public:
    /// Nothing moves.
    NodeMotion() = default;
    /// Leaves the model in its pose at the opening. `open` and `close` [s] are times of the
    /// animation. Throws `Error` (invalid_input).
    NodeMotion(tinygltf::Model& model, std::span<const AnimatedProperty> properties, double open,
               double close, LoadContext& context);

    /// After the opening; 0: nothing moves.
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// Node space to world space at `steps()` + 1 times; empty: the node stands still.
    [[nodiscard]] std::span<const glm::dmat4> world(std::size_t node) const;
    /// Of morph targets, likewise.
    [[nodiscard]] std::span<const std::vector<double>> weights(std::size_t node) const;

private:
    std::size_t steps_ = 0;
    std::map<std::size_t, std::vector<glm::dmat4>> world_;
    std::map<std::size_t, std::vector<std::vector<double>>> weights_;
};

}  // namespace bdpt::io
