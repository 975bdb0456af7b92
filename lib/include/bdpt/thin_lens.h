#pragma once

#include <bdpt/export.h>

namespace bdpt {

/// Radius [m] of a lens with this f-number and vertical field of view [rad] in front of a sensor
/// that is 24 mm high, as that of a 35 mm still camera. The focal length f = 12 mm / tan(fov / 2)
/// is f-number times the lens' diameter.
[[nodiscard]] BDPT_EXPORT double lens_radius_of(double f_number, double vertical_fov);

/// Vertical field of view [rad] of a lens with this focal length [m] > 0 before such a sensor.
[[nodiscard]] BDPT_EXPORT double vertical_fov_of(double focal_length);

}  // namespace bdpt
