#pragma once

#include "light/learned/entries.h"
#include "light/light_model.h"
#include "light/light_samples.h"

#include <bdpt/scene_desc.h>

#include <span>

namespace bdpt {

/// Parallel light from infinity: delta in direction.
class DirectionalLight : public DeltaLight, public InfiniteLight {
public:
    /// The motion of `desc` must outlive this.
    DirectionalLight(const DirectionalLightDesc& desc, const BoundingSphere& bounds);

    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, Vec2 /*u_direction*/,
                                                 float time) const
    {
        return sample_emission(u_position, time, EntryWindow(bounds_));
    }
    /// Starts light where it enters, as learned.
    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, float time,
                                                 const EntryWindow& window) const;
    [[nodiscard]] IncidentSample sample_incident(const LightSampleContext& receiver, Vec2 u,
                                                 EnvironmentSampling sampling, float time) const;
    /// Returns the luminous flux through the scene's disk [lm].
    [[nodiscard]] Rgb power() const;

private:
    [[nodiscard]] Vec3 direction(float time) const;

    Vec3 direction_;
    Rgb illuminance_;
    BoundingSphere bounds_;
    Vec3 axis_;  ///< as described, of any length
    std::span<const Vec3> turn_;
};

}  // namespace bdpt
