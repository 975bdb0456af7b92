#pragma once

#include "light/light_bounds.h"
#include "light/light_samples.h"
#include "light/spot_cone.h"

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
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 direction) const { return cone_.pdf(direction); }
    /// Luminous flux [lm].
    [[nodiscard]] Rgb power() const { return intensity_ * cone_.integral(); }
    [[nodiscard]] LightBounds bounds() const;

private:
    Vec3 position_;
    Rgb intensity_;  // [cd]
    SpotCone cone_;
};

}  // namespace bdpt
