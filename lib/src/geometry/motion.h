#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace bdpt {

/// Position of a time among the steps of a motion.
struct TimeStep {
    std::size_t index = 0;  ///< index of the step before it
    float fraction = 0.0f;  ///< fraction of the interval to the next step
};

/// Returns the position of `time` in [0, 1] among `steps`, at least 1. The arithmetic is that of
/// Embree.
[[nodiscard]] inline TimeStep time_step(float time, std::size_t steps)
{
    const float scaled = time * static_cast<float>(steps);
    const std::size_t index = std::min(static_cast<std::size_t>(scaled), steps - 1);
    return {index, scaled - static_cast<float>(index)};
}

template <typename T>
[[nodiscard]] T between(const T& a, const T& b, float fraction)
{
    return (1.0f - fraction) * a + fraction * b;
}

/// Returns value number `step` of a motion.
template <typename T>
[[nodiscard]] const T& at_step(const T& first, std::span<const T> later, std::size_t step)
{
    return step == 0 || later.empty() ? first : later[step - 1];
}

/// Returns a value at a time in [0, 1]: `first` at shutter open, and interpolated through `later`.
template <typename T>
[[nodiscard]] T at_time(const T& first, std::span<const T> later, float time)
{
    if (later.empty()) {
        return first;
    }
    const TimeStep step = time_step(time, later.size());
    return between(at_step(first, later, step.index), later[step.index], step.fraction);
}

/// Bounds of the matrices between two that `can_move`.
struct MotionBounds {
    double min_determinant = 0.0;  ///< minimum magnitude; 0: some may be singular
    double inverse_stretch = 0.0;  ///< maximum row sum of magnitudes of the inverses
};

[[nodiscard]] MotionBounds motion_bounds(const Mat4& from, const Mat4& to);

}  // namespace bdpt
