#pragma once

#include <bdpt/types.h>

namespace bdpt::eval {

/// Converts linear sRGB [IEC 61966-2-1] to the opponent space YCxCz [Flohr et al. 1993, Kolpatzik
/// and Bouman 1992]: components are luminance, red-green, blue-yellow. Linear, apart from an
/// offset.
[[nodiscard]] Vec3 opponent_from_linear(Rgb linear);
[[nodiscard]] Rgb linear_from_opponent(Vec3 opponent);

/// Converts linear sRGB in [0, 1] to CIE 1976 L*a*b*.
[[nodiscard]] Vec3 lab_from_linear(Rgb linear);
/// Converts L*a*b* to linear sRGB; outside [0, 1] for colours out of gamut.
[[nodiscard]] Rgb linear_from_lab(Vec3 lab);

}  // namespace bdpt::eval
