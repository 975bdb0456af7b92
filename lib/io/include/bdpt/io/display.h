#pragma once

/// @file
/// Turns a render into pixels for a screen, alone, over a background or with alpha.
///
/// @code{.cpp}
/// bdpt::io::DisplayImage shown(const bdpt::Image& image)
/// {
///     const float exposure = bdpt::io::automatic_exposure(image);
///     return bdpt::io::tone_map(image, exposure, bdpt::io::ToneCurve::pbr_neutral);
/// }
/// @endcode
///
/// @code{.cpp}
/// void write_over_white(const bdpt::Image& image, std::span<const float> alpha)
/// {
///     bdpt::io::DisplayOptions options;
///     options.curve = bdpt::io::ToneCurve::agx;
///     options.background = bdpt::io::SrgbColor{255, 255, 255};
///     bdpt::io::write_png("white.png", bdpt::io::to_display(image, alpha, options), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// Tone curve: maps scene-linear colours, which are unbounded, to display colours.
enum class ToneCurve : std::uint8_t {
    filmic,       ///< the look of film: contrast, and highlights that fade to white
    pbr_neutral,  ///< keeps base colours under grey light: for products
    agx,          ///< soft highlights and muted colours
    none,         ///< clamps
};

/// All tone curves, in this order.
inline constexpr std::array all_tone_curves{ToneCurve::filmic, ToneCurve::pbr_neutral,
                                            ToneCurve::agx, ToneCurve::none};

/// Returns "filmic", "pbr-neutral", "agx" or "none".
[[nodiscard]] BDPT_EXPORT std::string_view tone_curve_name(ToneCurve curve);

// Maps from scene-linear to display-linear Rec. 709 in [0, 1]. NaN and negative components count as
// 0, those above 1e6 as 1e6.

/// Applies a filmic curve [Narkowicz 2016, ACES Filmic Tone Mapping Curve] to the largest
/// component; hues are kept, and bright ones fade to white.
[[nodiscard]] BDPT_EXPORT Rgb filmic(Rgb scene_linear);

/// Applies the Khronos PBR Neutral Tone Mapper [Khronos 2024, specification of that name]. A
/// dielectric's base colour in [0.04, 0.76] under light of 1 is reproduced: the 0.04 of specular
/// reflection is subtracted. Brighter values are compressed and fade to white.
[[nodiscard]] BDPT_EXPORT Rgb pbr_neutral(Rgb scene_linear);

/// Applies AgX [Sobotka 2022] with the polynomial that Wrensch [2023, Minimal AgX Implementation]
/// fitted to its curve, on Rec. 2020 primaries, as in viewers of glTF files.
[[nodiscard]] BDPT_EXPORT Rgb agx(Rgb scene_linear);

/// Applies the given curve.
[[nodiscard]] BDPT_EXPORT Rgb apply(ToneCurve curve, Rgb scene_linear);

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

/// An sRGB-encoded colour [IEC 61966-2-1]: red, green, blue.
using SrgbColor = std::array<std::uint8_t, 3>;

/// Options of the conversion of an image for a screen.
struct DisplayOptions {
    float exposure = 0.0f;  ///< pixels are multiplied by 2^exposure [EV]
    ToneCurve curve = ToneCurve::filmic;
    TexelType type = TexelType::unorm8;  ///< type of the result: unorm8 or unorm16
    /// Background where the image covers nothing; none: the result has alpha.
    std::optional<SrgbColor> background{};
    /// Image shown instead of the background, of the same size: display-linear, from black 0 to
    /// white 1. Null: none.
    const Image* backplate = nullptr;
    /// Fraction of each pixel's coverage that is a black shadow behind the image; empty: none.
    std::span<const float> shadow{};
};

/// Returns tone-mapped, sRGB-encoded pixels. `coverage`, in [0, 1], is the alpha of each pixel, by
/// which its colour is premultiplied; empty: all pixels are opaque. Colours are divided by the
/// coverage less the shadow before they are tone-mapped. The result has three channels, composed
/// over background or backplate in display-linear light, or four with straight alpha. Throws
/// `Error` (usage) if `coverage` does not have one value per pixel, `shadow` has neither none nor
/// one per pixel, `backplate` has another size, or the type is another.
[[nodiscard]] BDPT_EXPORT TexelImage to_display(const Image& image, std::span<const float> coverage,
                                                const DisplayOptions& options);

}  // namespace bdpt::io
