#pragma once

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "file/load_context.h"
#include "gltf/document/document.h"

namespace bdpt::io {

/// Interpolation between key frames [glTF 2.0, sec. 5.7.3].
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

/// Kind of interpolated values.
enum class Quantity : std::uint8_t {
    numbers,   ///< component by component
    rotation,  ///< a quaternion x, y, z, w; the result has unit length
};

/// Key frames of one animated property. Each time has `width` values; with cubic splines three
/// times as many: in-tangents, values, out-tangents.
struct KeyFrames {
    std::vector<float> times;  ///< [s], increasing; at least one
    std::vector<float> values;
    std::size_t width = 0;
    Interpolation interpolation = Interpolation::linear;
};

/// Interpolates the values at a time [s]; before the first and after the last key frame they are
/// constant [glTF 2.0, Appendix C]. Rotations take the shorter way, by slerp.
[[nodiscard]] std::vector<double> value_at(const KeyFrames& frames, Quantity quantity, double time);

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
