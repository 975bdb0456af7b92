#pragma once

#include <bdpt/scene_desc.h>

namespace bdpt {

/// A homogeneous participating medium [Pharr et al. 2023, ch. 11].
struct Medium {
    Rgb extinction{0.0f};     ///< sigma_t: absorption and scattering [1/m]
    Rgb scattering{0.0f};     ///< sigma_s [1/m], at most the extinction
    float anisotropy = 0.0f;  ///< g of the Henyey-Greenstein phase function, in (-1, 1)

    [[nodiscard]] bool is_clear() const { return extinction == Rgb(0.0f); }
    [[nodiscard]] bool scatters() const { return scattering != Rgb(0.0f); }
    /// Returns about how often a walk scatters in a body before it is absorbed or leaves, in [1,
    /// 30]: the mean over the channels. `mean_chord` is the mean length of straight ways through
    /// the body [m]. Forward scattering counts like the isotropic scattering that moves light as
    /// far.
    [[nodiscard]] float mean_scatterings(float mean_chord) const;
    friend bool operator==(const Medium&, const Medium&) = default;
};

/// Tests whether light enters the inside of the body, refracted or not.
[[nodiscard]] bool has_inside(const MaterialDesc& desc);

/// Returns the inside of a body: extinction by KHR_materials_volume, scattering by
/// KHR_materials_volume_scatter. Clear for materials without these. A colour of zero absorbs like
/// 1e-20.
[[nodiscard]] Medium medium_within(const MaterialDesc& desc);

/// Returns the medium of fog.
[[nodiscard]] Medium make_medium(const MediumDesc& desc);

/// Returns the single-scattering albedo of a medium that looks as bright as `multiscatter_color`,
/// in [0, 1], where it is dense and lit from outside [Kulla and Conty 2017, "Revisiting Physically
/// Based Shading at Imageworks", slide 44]. `anisotropy` is g of its phase function, in (-1, 1).
[[nodiscard]] Rgb single_scatter_albedo(Rgb multiscatter_color, float anisotropy);

}  // namespace bdpt
