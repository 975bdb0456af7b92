#pragma once

/// @file
/// Maps scene-linear colours to those of a screen.
///
/// @code{.cpp}
/// for (const bdpt::io::ToneCurve curve : bdpt::io::all_tone_curves) {
///     const bdpt::Rgb shown = bdpt::io::apply(curve, {4.0f, 2.0f, 1.0f});
///     std::cout << bdpt::io::tone_curve_name(curve) << ": " << shown.r << '\n';
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/types.h>

#include <array>
#include <cstdint>
#include <string_view>

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

}  // namespace bdpt::io
