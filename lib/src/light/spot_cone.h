#pragma once

#include "light/tree/direction_cone.h"
#include "math/pdf.h"

#include <bdpt/types.h>

namespace bdpt {

/// The directions in which a light shines and how strongly: all alike, or a cone with the angular
/// attenuation of KHR_lights_punctual ("Inner and Outer Cone Angles").
class SpotCone {
public:
    /// All directions.
    SpotCone() = default;
    /// Around `axis`, which has any length; angles [rad] from it as in `SpotLightDesc`.
    SpotCone(Vec3 axis, float inner_angle, float outer_angle);

    /// The same around another axis.
    [[nodiscard]] SpotCone around(Vec3 axis) const;

    /// Uniform within the outer cone, unit.
    [[nodiscard]] Vec3 sample(Vec2 u) const;
    /// Of `sample`.
    [[nodiscard]] SolidAnglePdf pdf(Vec3 direction) const;
    /// In [0, 1], for the unit direction in which the light leaves.
    [[nodiscard]] float falloff(Vec3 direction) const;

    /// Of the outer cone [sr].
    [[nodiscard]] float solid_angle() const;
    /// Of `falloff` over all directions [sr].
    [[nodiscard]] float integral() const;

    /// The directions of the full intensity, and the cosine of the angle from them beyond which
    /// there is none.
    [[nodiscard]] DirectionCone full() const { return {.axis = axis_, .cos_angle = cos_inner_}; }
    [[nodiscard]] float cos_falloff() const;

private:
    [[nodiscard]] bool is_whole() const { return one_minus_cos_outer_ >= 2.0f; }

    Vec3 axis_{0.0f, 0.0f, 1.0f};
    float cos_inner_ = -1.0f;
    float one_minus_cos_outer_ = 2.0f;
};

}  // namespace bdpt
