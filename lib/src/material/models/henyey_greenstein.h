#pragma once

#include "material/models/scattering_model.h"

namespace bdpt {

/// Scattering at a point of a medium. Local directions are about +z = wo, so that the light goes on
/// along -z; there is no surface, and no cosine in `f_cos` [Henyey and Greenstein 1941, "Diffuse
/// Radiation in the Galaxy"].
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
    /// [1/sr], by one minus the cosine between wi and the direction that is scattered to most.
    [[nodiscard]] float phase(float from_peak) const noexcept;

    Rgb scattering_;
    float anisotropy_;
};

static_assert(ScatteringModel<HenyeyGreenstein>);

}  // namespace bdpt
