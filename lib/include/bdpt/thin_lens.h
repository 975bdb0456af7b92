#pragma once

/// @file
/// Computes lens radii from f-numbers, and fields of view from focal lengths.
///
/// @code{.cpp}
/// const double fov = bdpt::compute_vertical_fov(0.085);  // a lens of 85 mm
/// bdpt::CameraDesc camera = bdpt::look_at({0, 1, 3}, {0, 1, 0}, static_cast<float>(fov));
/// camera.lens_radius = static_cast<float>(bdpt::compute_lens_radius(1.8, fov));
/// camera.focus_distance = 3.0f;
/// @endcode

#include <bdpt/export.h>

namespace bdpt {

/// Returns the radius [m] of a lens with this f-number and vertical field of view [rad] in front of
/// a sensor of 24 mm height, that of a 35 mm still camera. The focal length f = 12 mm / tan(fov /
/// 2) is the f-number times the diameter of the lens.
[[nodiscard]] BDPT_EXPORT double compute_lens_radius(double f_number, double vertical_fov);

/// Returns the vertical field of view [rad] of a lens with this focal length [m] > 0 in front of
/// such a sensor.
[[nodiscard]] BDPT_EXPORT double compute_vertical_fov(double focal_length);

}  // namespace bdpt
