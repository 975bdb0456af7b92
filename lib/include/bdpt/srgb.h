#pragma once

/// @file
/// Computes linear values from sRGB codes.
///
/// @code{.cpp}
/// const float red = bdpt::srgb_to_linear(0xf0 / 255.0);
/// const float green = bdpt::srgb_to_linear(0xa0 / 255.0);
/// const float blue = bdpt::srgb_to_linear(0x20 / 255.0);
/// bdpt::MaterialDesc paint;
/// paint.base_color = {red, green, blue, 1.0f};  // #f0a020
/// @endcode

namespace bdpt {

/// Returns x^2.4 for x in (0, 1], by Newton's method for the fifth root of x^2. Bit-identical on
/// all machines: it needs no C library.
[[nodiscard]] constexpr double power_2_4(double x)
{
    const double square = x * x;
    double root = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double fourth = root * root * root * root;
        root -= (root * fourth - square) / (5.0 * fourth);
    }
    return square * root;
}

/// Returns the linear value of an sRGB code in [0, 1]: the electro-optical function of IEC
/// 61966-2-1.
[[nodiscard]] constexpr float srgb_to_linear(double code)
{
    return static_cast<float>(code <= 0.04045 ? code / 12.92 : power_2_4((code + 0.055) / 1.055));
}

}  // namespace bdpt
