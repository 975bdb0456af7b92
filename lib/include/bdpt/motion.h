#pragma once

/// @file
/// Checks what moves while the shutter is open.
///
/// @code{.cpp}
/// bdpt::InstanceDesc car;
/// bdpt::Mat4 later = car.world_from_object;
/// later[3].x += 0.2f;
/// if (bdpt::can_move(car.world_from_object, later)) {
///     car.motion = {later};  // where it is when the shutter closes
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/types.h>

#include <cstddef>
#include <span>

namespace bdpt {

// Motion blur. A sample of a pixel has one time, uniform from 0, when the shutter opens, to 1, when
// it closes; its camera path and its light paths see the scene at that time. A pixel is the mean
// over that time, so a longer exposure does not brighten the image.

/// Maximum number of values in a `motion` or `turn` of a `SceneDesc` or `CameraDesc`. [Embree
/// supports 129 with the first one.]
inline constexpr std::size_t max_time_steps = 128;

/// Tests whether transforms can be interpolated linearly: whether all matrices in between are
/// invertible, and none mirrors if the ends do not. A rotation of less than 120 degrees can.
/// Sufficient, not necessary: the test uses the Bernstein coefficients of the determinant.
[[nodiscard]] BDPT_EXPORT bool can_move(const Mat4& from, const Mat4& to);
/// Tests all steps of a motion.
[[nodiscard]] BDPT_EXPORT bool can_move(const Mat4& first, std::span<const Mat4> motion);

/// Tests whether a direction of any length can be interpolated linearly to another: whether the
/// angle is less than 90 degrees.
[[nodiscard]] BDPT_EXPORT bool can_turn(Vec3 from, Vec3 to);

}  // namespace bdpt
