#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::io {

/// How values between key frames follow from them [glTF 2.0, sec. 5.7.3].
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

/// What is interpolated.
enum class Quantity : std::uint8_t {
    numbers,   ///< one by one
    rotation,  ///< a quaternion x, y, z, w; the result has unit length
};

/// One animated property. For each time there are `width` values; with cubic splines three times as
/// many: in-tangents, values, out-tangents.
struct KeyFrames {
    std::vector<float> times;  ///< [s], increasing; at least one
    std::vector<float> values;
    std::size_t width = 0;
    Interpolation interpolation = Interpolation::linear;
};

/// The values at a time [s]; before the first and after the last key frame those of that frame
/// [glTF 2.0, Appendix C]. Rotations take the shorter way, by slerp.
[[nodiscard]] std::vector<double> value_at(const KeyFrames& frames, Quantity quantity, double time);

}  // namespace bdpt::io
