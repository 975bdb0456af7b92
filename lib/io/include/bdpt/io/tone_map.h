#pragma once

/// @file
/// Turns a render into pixels for a screen.
///
/// @code{.cpp}
/// bdpt::io::DisplayImage shown(const bdpt::Image& image)
/// {
///     const float exposure = bdpt::io::automatic_exposure(image);
///     return bdpt::io::tone_map(image, exposure, bdpt::io::ToneCurve::pbr_neutral);
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/io/tone_curve.h>

#include <cstdint>
#include <vector>

namespace bdpt::io {

/// Row-major pixels ready for a screen: sRGB-encoded [IEC 61966-2-1]; row 0 is the top row.
struct DisplayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// Returns the exposure [EV] that maps the image's log-average luminance to a key: 0.18, or up to
/// 0.36 for an image that is bright but for a few shadows [after Reinhard 2002, Parameter
/// Estimation for Photographic Tone Reproduction]. Black, NaN and infinite pixels do not count, nor
/// do the brightest and darkest hundredth. Scaling all pixels by k lowers the exposure by log2(k).
/// Returns 0 for a black image.
[[nodiscard]] BDPT_EXPORT float automatic_exposure(const Image& image);

/// Encodes `linear`, clamped to [0, 1]; NaN gives 0. Rounds to nearest.
[[nodiscard]] BDPT_EXPORT std::uint8_t encode_srgb(float linear);

/// Multiplies each pixel by 2^exposure [EV], then applies the curve and `encode_srgb`.
[[nodiscard]] BDPT_EXPORT DisplayImage tone_map(const Image& image, float exposure,
                                                ToneCurve curve = ToneCurve::filmic);

}  // namespace bdpt::io
