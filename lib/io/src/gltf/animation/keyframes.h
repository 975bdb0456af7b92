#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace bdpt::io
