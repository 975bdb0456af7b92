#pragma once

#include "material/models/scattering_model.h"

namespace bdpt {

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
