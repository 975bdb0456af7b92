#pragma once

#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/point_emission.h"
#include "light/tree/light_bounds.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>

namespace bdpt {

/// A point or spot light of KHR_lights_punctual: delta in position, so no ray ever hits it. A point
/// light is a spot whose cone is the whole sphere.
class PunctualLight : public DeltaLight {
public:
    static constexpr bool is_infinite = false;

    /// The motion of `desc` must outlive this.
    explicit PunctualLight(const PointLightDesc& desc);
    explicit PunctualLight(const SpotLightDesc& desc);

    /// Samples directions uniformly in the cone.
    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction,
                                                 float time) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 /*ng*/, Vec3 direction, float time) const
    {
        return cone(time).pdf(direction);
    }
    /// Returns the luminous flux [lm].
    [[nodiscard]] Rgb power() const { return intensity_ * cone_.integral(); }
    [[nodiscard]] LightBounds bounds() const;

private:
    [[nodiscard]] Vec3 position(float time) const;
    [[nodiscard]] SpotCone cone(float time) const;

    Vec3 position_;
    Rgb intensity_;  // [cd]
    SpotCone cone_;
    Vec3 axis_{0.0f, 0.0f, 1.0f};
    std::span<const Vec3> motion_;
    std::span<const Vec3> turn_;
};

}  // namespace bdpt
