#include "metrics/color_spaces.h"

#include <cmath>

namespace bdpt::eval {
namespace {

/// White point D65 as in [Andersson et al. 2020]; CIE XYZ with Y = 1.
constexpr Vec3 white(0.950428545f, 1.0f, 1.088900371f);

/// Converts to CIE XYZ relative to the white point, so that (1, 1, 1) is white: the primaries of
/// sRGB, derived from their chromaticities (0.64, 0.33), (0.30, 0.60), (0.15, 0.06).
Vec3 relative_xyz_from_linear(Rgb c)
{
    const Vec3 xyz(0.4123865627f * c.r + 0.3575914911f * c.g + 0.1804504912f * c.b,
                   0.2126368214f * c.r + 0.7151829821f * c.g + 0.0721801965f * c.b,
                   0.0193306201f * c.r + 0.1191971637f * c.g + 0.9503725872f * c.b);
    return xyz / white;
}

/// Inverts `relative_xyz_from_linear`.
Rgb linear_from_relative_xyz(Vec3 relative)
{
    const Vec3 c = relative * white;
    return {3.2410032373f * c.x - 1.5373989715f * c.y - 0.4986158827f * c.z,
            -0.9692242518f * c.x + 1.8759299830f * c.y + 0.0415542263f * c.z,
            0.0556394198f * c.x - 0.2040112061f * c.y + 1.0571489770f * c.z};
}

// Knee of CIE 1976: below its cube the root is replaced by a line.
constexpr float knee = 6.0f / 29.0f;

float lab_curve(float t)
{
    return t > knee * knee * knee ? std::cbrt(t) : t / (3.0f * knee * knee) + 4.0f / 29.0f;
}

float inverse_lab_curve(float t)
{
    return t > knee ? t * t * t : 3.0f * knee * knee * (t - 4.0f / 29.0f);
}

}  // namespace

Vec3 opponent_from_linear(Rgb linear)
{
    const Vec3 xyz = relative_xyz_from_linear(linear);
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

Rgb linear_from_opponent(Vec3 opponent)
{
    const float y = (opponent.x + 16.0f) / 116.0f;
    return linear_from_relative_xyz({y + opponent.y / 500.0f, y, y - opponent.z / 200.0f});
}

Vec3 lab_from_linear(Rgb linear)
{
    const Vec3 xyz = relative_xyz_from_linear(linear);
    const Vec3 f(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    return {116.0f * f.y - 16.0f, 500.0f * (f.x - f.y), 200.0f * (f.y - f.z)};
}

Rgb linear_from_lab(Vec3 lab)
{
    const float y = (lab.x + 16.0f) / 116.0f;
    return linear_from_relative_xyz({inverse_lab_curve(y + lab.y / 500.0f), inverse_lab_curve(y),
                                     inverse_lab_curve(y - lab.z / 200.0f)});
}

}  // namespace bdpt::eval
