#pragma once

#include <bdpt/export.h>

namespace bdpt {

/// Returns the radius [m] of a lens with this f-number and vertical field of view [rad] in front of
/// a sensor of 24 mm height, that of a 35 mm still camera. The focal length f = 12 mm / tan(fov /
/// 2) is the f-number times the diameter of the lens.
[[nodiscard]] BDPT_EXPORT double lens_radius_of(double f_number, double vertical_fov);

/// Returns the vertical field of view [rad] of a lens with this focal length [m] > 0 in front of
/// such a sensor.
[[nodiscard]] BDPT_EXPORT double vertical_fov_of(double focal_length);

}  // namespace bdpt
