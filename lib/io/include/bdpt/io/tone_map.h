#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstdint>
#include <vector>

namespace bdpt::io {

/// Row-major pixels ready for a screen: sRGB-encoded [IEC 61966-2-1]; row 0 is the top row.
struct DisplayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// The exposure [EV] that brings the image's log-average luminance to a key: 0.18, or up to 0.36
/// for an image that is bright but for a few shadows [after Reinhard 2002, Parameter Estimation
/// for Photographic Tone Reproduction]. Black, NaN and infinite pixels do not count, nor do the
/// brightest and darkest hundredth. Scaling all pixels by k lowers it by log2(k). 0 for a black
/// image.
[[nodiscard]] BDPT_EXPORT float automatic_exposure(const Image& image);

/// From scene-linear to display-linear [0, 1]: a filmic curve [Narkowicz 2016, ACES Filmic Tone
/// Mapping Curve] on the largest component; hues stay, and bright ones fade to white. NaN and
/// negative components count as 0.
[[nodiscard]] BDPT_EXPORT Rgb filmic(Rgb scene_linear);

/// `linear` in [0, 1], else it is clamped; NaN gives 0. Rounds to the nearest.
[[nodiscard]] BDPT_EXPORT std::uint8_t encode_srgb(float linear);

/// Multiplies each pixel by 2^exposure [EV], then applies `filmic` and `encode_srgb`.
[[nodiscard]] BDPT_EXPORT DisplayImage tone_map(const Image& image, float exposure);

}  // namespace bdpt::io
