#pragma once

#include <cmath>

namespace bdpt {

/// Radius [m] of a lens with this f-number and vertical field of view [rad] in front of a sensor
/// that is 24 mm high, as that of a 35 mm still camera. The focal length f = 12 mm / tan(fov / 2)
/// is f-number times the lens' diameter.
[[nodiscard]] inline double lens_radius_of(double f_number, double vertical_fov)
{
    constexpr double half_sensor = 0.012;
    const double focal_length = half_sensor / std::tan(0.5 * vertical_fov);
    return focal_length / (2.0 * f_number);
}

}  // namespace bdpt
