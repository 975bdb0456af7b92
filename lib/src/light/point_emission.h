#pragma once

#include "light/light_samples.h"
#include "light/light_tree.h"
#include "math/pdf.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>

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

/// Returns the light of a point light at a receiver: its intensity, `intensity` times
/// `falloff(direction)` of the direction away from it, over the squared distance. nullopt if that
/// is 0.
template <typename Falloff>
[[nodiscard]] std::optional<IncidentSample> incident_from_point(Vec3 position, Vec3 receiver,
                                                                Rgb intensity,
                                                                const Falloff& falloff)
{
    const Vec3 to_light = position - receiver;
    const float distance_squared = dot(to_light, to_light);
    if (!(distance_squared > 0.0f)) {
        return std::nullopt;
    }
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float attenuation = falloff(-wi);
    if (attenuation == 0.0f) {
        return std::nullopt;
    }
    return IncidentSample{.end = {.p = position},
                          .wi = wi,
                          .distance = distance,
                          .weight = intensity * (attenuation / distance_squared),
                          .pdf = {1.0f},
                          .pdf_solid_angle = {1.0f}};
}

}  // namespace bdpt
