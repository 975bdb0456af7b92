#include <bdpt/thin_lens.h>

#include "math/elementary.h"

namespace bdpt {

double lens_radius_of(double f_number, double vertical_fov)
{
    constexpr double half_sensor = 0.012;
    const SinCos half = sin_cos(static_cast<float>(0.5 * vertical_fov));
    const double focal_length =
        half_sensor * static_cast<double>(half.cos) / static_cast<double>(half.sin);
    return focal_length / (2.0 * f_number);
}

}  // namespace bdpt
