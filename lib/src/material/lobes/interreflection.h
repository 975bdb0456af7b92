#pragma once

#include "material/lobes/diffuse_reflection.h"
#include "material/lobes/fresnel.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <algorithm>

namespace bdpt {

/// What rough metal reflects after more than one reflection among its microfacets
/// [Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks"]: diffuse light, in
/// proportion to what microfacets that reflect all light do not reflect at once, of wo and of wi.
/// Reciprocal; with a reflectance of 1 both lobes together reflect all light.
class Interreflection {
public:
    /// `f0`: of the metal at normal incidence. `average`: the cosine-weighted average of what white
    /// microfacets reflect at once, in [0, 1]. `share`: of the surface that is metal.
    Interreflection(Rgb f0, float average, float share)
    {
        const Rgb reflectance = f0 + (1.0f - f0) * mean_schlick_weight;
        const float missing = std::max(1.0f - average, min_missing);
        // Light is reflected once, as often again as microfacets mask it, and leaves.
        albedo_ = share * reflectance * reflectance * average /
                  (Rgb(1.0f) - reflectance * (1.0f - average));
        per_coupling_ = inv_pi / missing;
    }

    /// The largest channel of the share of what is not reflected at once that leaves after all.
    [[nodiscard]] float weight() const { return max_component(albedo_); }

    /// The lobe between directions of which white microfacets leave these shares unreflected.
    [[nodiscard]] DiffuseReflection lobe(float unreflected_o, float unreflected_i) const
    {
        return DiffuseReflection(albedo_ * per_coupling_, unreflected_o * unreflected_i);
    }

private:
    static constexpr float min_missing = 1e-6f;

    Rgb albedo_;
    float per_coupling_;
};

}  // namespace bdpt
