#pragma once

/// @file
/// Prepares an image for a screen, over a background or with alpha.
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
#include <bdpt/io/tone_curve.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace bdpt::io {

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
