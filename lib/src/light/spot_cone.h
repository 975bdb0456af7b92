#pragma once

#include "light/tree/direction_cone.h"
#include "math/pdf.h"

#include <bdpt/types.h>

namespace bdpt {

/// Angular distribution of a light's intensity: uniform, or a cone with the angular attenuation of
/// KHR_lights_punctual ("Inner and Outer Cone Angles").
class SpotCone {
public:
    /// Constructs the uniform distribution.
    SpotCone() = default;
    /// Constructs a cone around `axis`, which has any length; angles from it [rad] as in
    /// `SpotLightDesc`.
    SpotCone(Vec3 axis, float inner_angle, float outer_angle);

    /// Returns the same distribution around another axis.
    [[nodiscard]] SpotCone around(Vec3 axis) const;

    /// Samples a unit direction uniformly within the outer cone.
    [[nodiscard]] Vec3 sample(Vec2 u) const;
    /// Returns the density of `sample`.
    [[nodiscard]] SolidAnglePdf pdf(Vec3 direction) const;
    /// Returns the attenuation in [0, 1] of the unit direction in which light leaves.
    [[nodiscard]] float falloff(Vec3 direction) const;

    /// Returns the solid angle of the outer cone [sr].
    [[nodiscard]] float solid_angle() const;
    /// Returns the integral of `falloff` over all directions [sr].
    [[nodiscard]] float integral() const;

    /// Returns the directions of full intensity; `cos_falloff` is the cosine of the angle from them
    /// beyond which there is none.
    [[nodiscard]] DirectionCone full() const { return {.axis = axis_, .cos_angle = cos_inner_}; }
    [[nodiscard]] float cos_falloff() const;

private:
    [[nodiscard]] bool is_whole() const { return one_minus_cos_outer_ >= 2.0f; }

    Vec3 axis_{0.0f, 0.0f, 1.0f};
    float cos_inner_ = -1.0f;
    float one_minus_cos_outer_ = 2.0f;
};

}  // namespace bdpt
