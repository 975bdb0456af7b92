#pragma once

#include "material/lobes/diffuse_reflection.h"
#include "material/models/scattering_model.h"
#include "math/elementary.h"

namespace bdpt {

/// A diffuse surface without a boundary above it.
class Lambertian {
public:
    /// In [0, 1], not black (that is `Black`).
    explicit Lambertian(Rgb base_color) : base_color_(base_color) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return grazes(wo) || grazes(wi) ? BsdfEval{} : lobe().eval(wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        if (grazes(wo)) {
            return std::nullopt;
        }
        const Vec3 wi = lobe().sample(wo, u_lobe, u, mode)->wi;
        return grazes(wi) ? std::nullopt : smooth_sample(wi, lobe().eval(wo, wi, mode));
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return true; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return base_color_; }

private:
    [[nodiscard]] DiffuseReflection lobe() const { return DiffuseReflection(base_color_ * inv_pi); }

    Rgb base_color_;
};

static_assert(ScatteringModel<Lambertian>);

}  // namespace bdpt
