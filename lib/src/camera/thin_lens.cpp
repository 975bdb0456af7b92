#include <bdpt/thin_lens.h>

#include "math/elementary.h"

namespace bdpt {

namespace {

constexpr double half_sensor = 0.012;  // [m]

}  // namespace

double compute_lens_radius(double f_number, double vertical_fov)
{
    const SinCos half = sin_cos(static_cast<float>(0.5 * vertical_fov));
    const double focal_length =
        half_sensor * static_cast<double>(half.cos) / static_cast<double>(half.sin);
    return focal_length / (2.0 * f_number);
}

double compute_vertical_fov(double focal_length)
{
    const auto half =
        atan2_exact(static_cast<float>(half_sensor), static_cast<float>(focal_length));
    return 2.0 * static_cast<double>(half);
}

}  // namespace bdpt
