#pragma once

#include "material/models/scattering_model.h"

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

/// Phase function of a medium. Local directions are around +z = wo, so that unscattered light
/// continues along -z; there is no surface, and no cosine in `f_cos` [Henyey and Greenstein 1941,
/// "Diffuse Radiation in the Galaxy"].
class HenyeyGreenstein {
public:
    /// `scattering` [1/m] is not black; `anisotropy` is in (-1, 1), > 0 forwards.
    HenyeyGreenstein(Rgb scattering, float anisotropy)
        : scattering_(scattering), anisotropy_(anisotropy)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return true; }
    [[nodiscard]] bool transmits() const noexcept { return true; }
    [[nodiscard]] Rgb base_color() const noexcept { return Rgb(1.0f); }

private:
    /// Returns the phase function [1/sr], given one minus the cosine between wi and the peak
    /// direction.
    [[nodiscard]] float phase(float from_peak) const noexcept;

    Rgb scattering_;
    float anisotropy_;
};

static_assert(ScatteringModel<HenyeyGreenstein>);

}  // namespace bdpt
