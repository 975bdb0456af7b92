#pragma once

#include "light/light_samples.h"

#include <bdpt/scene_desc.h>

#include <optional>

namespace bdpt {

/// A point or spot light of KHR_lights_punctual: delta in position, so no ray ever hits it. A point
/// light is a spot whose cone is the whole sphere.
class PunctualLight {
public:
    explicit PunctualLight(const PointLightDesc& desc);
    explicit PunctualLight(const SpotLightDesc& desc);

    /// Directions are uniform in the cone.
    [[nodiscard]] EmissionSample sample_emission(Vec2 u) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(Vec3 receiver) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 direction) const;
    /// Luminous flux [lm].
    [[nodiscard]] Rgb power() const;

private:
    [[nodiscard]] float falloff(Vec3 direction) const;
    [[nodiscard]] float solid_angle() const;

    Vec3 position_;
    Vec3 axis_{0.0f, 0.0f, 1.0f};
    Rgb intensity_;  // [cd]
    float cos_inner_ = -1.0f;
    float one_minus_cos_outer_ = 2.0f;
};

}  // namespace bdpt
