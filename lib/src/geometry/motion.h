#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace bdpt {

/// Where a time lies among the steps of a motion.
struct TimeStep {
    std::size_t index = 0;  ///< of the step before it
    float fraction = 0.0f;  ///< of the way to the next one
};

/// `time` is in [0, 1], `steps` at least 1. The arithmetic is that of Embree.
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

/// Value number `step` of a motion.
template <typename T>
[[nodiscard]] const T& at_step(const T& first, std::span<const T> later, std::size_t step)
{
    return step == 0 || later.empty() ? first : later[step - 1];
}

/// What is `first` when the shutter opens and moves as `later` says, at a time in [0, 1].
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
    double min_determinant = 0.0;  ///< magnitude; 0: some may have none
    double inverse_stretch = 0.0;  ///< greatest sum of a row of the inverses, by magnitude
};

[[nodiscard]] MotionBounds motion_bounds(const Mat4& from, const Mat4& to);

}  // namespace bdpt
