#pragma once

#include <bdpt/types.h>

namespace bdpt::eval {

/// Linear sRGB [IEC 61966-2-1] as the opponent space YCxCz [Flohr et al. 1993, Kolpatzik and Bouman
/// 1992]: components are luminance, red-green, blue-yellow. Linear, apart from an offset.
[[nodiscard]] Vec3 opponent_from_linear(Rgb linear);
[[nodiscard]] Rgb linear_from_opponent(Vec3 opponent);

/// Linear sRGB in [0, 1] as CIE 1976 L*a*b*.
[[nodiscard]] Vec3 lab_from_linear(Rgb linear);
/// May be out of [0, 1], for colours that sRGB does not have.
[[nodiscard]] Rgb linear_from_lab(Vec3 lab);

}  // namespace bdpt::eval
