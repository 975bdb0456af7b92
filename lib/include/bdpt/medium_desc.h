#pragma once

/// @file
/// Describes fog.
///
/// @code{.cpp}
/// bdpt::SceneDesc desc = bdpt::io::load_gltf("street.glb").scene;
/// desc.fog = bdpt::MediumDesc{.extinction = bdpt::Rgb(0.02f)};  // a mean free path of 50 m
/// const bdpt::Scene scene(std::move(desc));
/// @endcode

#include <bdpt/fields.h>
#include <bdpt/types.h>

namespace bdpt {

/// Maximum magnitude of the anisotropy; the phase functions of -1 and 1 scatter all light into one
/// direction.
inline constexpr float max_anisotropy = 0.9999f;

/// A homogeneous medium that absorbs and scatters light, such as fog [Pharr et al. 2023, Physically
/// Based Rendering, ch. 11].
struct MediumDesc {
    /// Extinction coefficient [1/m], >= 0: absorption and scattering; 1 / the mean free path.
    Rgb extinction{0.0f};
    Rgb albedo{1.0f};         ///< single-scattering albedo, [0, 1]
    float anisotropy = 0.0f;  ///< g of Henyey and Greenstein, in (-1, 1); > 0 scatters forwards
};
/// Fields of `MediumDesc`, with names and limits.
template <>
inline constexpr auto fields<MediumDesc> = all_fields(
    Number{"extinction", &MediumDesc::extinction, Limits::at_least(0.0f)},
    Number{"albedo", &MediumDesc::albedo, Limits::unit()},
    Number{"anisotropy", &MediumDesc::anisotropy, Limits{-max_anisotropy, max_anisotropy}});

}  // namespace bdpt
