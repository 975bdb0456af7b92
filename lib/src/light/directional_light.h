#pragma once

#include "light/bounding_sphere.h"
#include "light/light_samples.h"

#include <bdpt/scene_desc.h>

namespace bdpt {

/// Parallel light from infinity: delta in direction.
class DirectionalLight {
public:
    DirectionalLight(const DirectionalLightDesc& desc, const BoundingSphere& bounds);

    [[nodiscard]] EmissionSample sample_emission(Vec2 u) const;
    [[nodiscard]] IncidentSample sample_incident() const;
    /// Luminous flux through the scene's disk [lm].
    [[nodiscard]] Rgb power() const;

private:
    Vec3 direction_;
    Rgb illuminance_;
    BoundingSphere bounds_;
};

}  // namespace bdpt
