#pragma once

#include "material/lobes/diffuse_reflection.h"
#include "material/lobes/fresnel.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <algorithm>

namespace bdpt {

/// Multiple reflection among the microfacets of rough metal [Kulla and Conty 2017, "Revisiting
/// Physically Based Shading at Imageworks"]: diffuse light, in proportion to the light that white
/// microfacets do not reflect at once, of wo and of wi. Reciprocal; with a reflectance of 1 both
/// lobes together reflect all light.
class Interreflection {
public:
    /// `f0` is the reflectance of the metal at normal incidence, `average` the cosine-weighted
    /// average of the light that white microfacets reflect at once, in [0, 1], `share` the metallic
    /// fraction of the surface.
    Interreflection(Rgb f0, float average, float share)
    {
        const Rgb reflectance = f0 + (1.0f - f0) * mean_schlick_weight;
        const float missing = std::max(1.0f - average, min_missing);
        // Light is reflected once, repeatedly as microfacets mask it, and leaves.
        albedo_ = share * reflectance * reflectance * average /
                  (Rgb(1.0f) - reflectance * (1.0f - average));
        per_coupling_ = inv_pi / missing;
    }

    /// Returns the largest channel of the fraction of light not reflected at once that eventually
    /// leaves.
    [[nodiscard]] float weight() const { return max_component(albedo_); }

    /// Returns the lobe between directions whose light white microfacets leave unreflected in these
    /// fractions.
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
