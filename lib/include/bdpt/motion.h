#pragma once

#include <bdpt/export.h>
#include <bdpt/types.h>

#include <cstddef>
#include <span>

namespace bdpt {

// Motion blur. A sample of a pixel has one time, uniform from 0, when the shutter opens, to 1, when
// it closes; its camera path and its light paths see the scene as it is then. A pixel is the mean
// over that time, so a longer exposure makes nothing brighter.

/// Most values that a `motion` or `turn` of a `SceneDesc` or `CameraDesc` may have. [Embree takes
/// 129 with the first one.]
inline constexpr std::size_t max_time_steps = 128;

/// Can things go from one transform to the other along a straight line of matrices: do all on the
/// way have an inverse, and does none mirror that the ends do not? A turn of less than 120 degrees
/// can. Sufficient, not necessary: it is asked of the coefficients of the determinant in
/// Bernstein's basis.
[[nodiscard]] BDPT_EXPORT bool can_move(const Mat4& from, const Mat4& to);
/// The same for all steps of a motion.
[[nodiscard]] BDPT_EXPORT bool can_move(const Mat4& first, std::span<const Mat4> motion);

/// Can a direction of any length turn to another along a straight line: is the angle less than 90
/// degrees?
[[nodiscard]] BDPT_EXPORT bool can_turn(Vec3 from, Vec3 to);

}  // namespace bdpt
