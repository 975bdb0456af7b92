#include "light/directional_light.h"

#include "geometry/motion.h"

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {

DirectionalLight::DirectionalLight(const DirectionalLightDesc& desc, const BoundingSphere& bounds)
    : direction_(normalize(desc.direction)),
      illuminance_(desc.illuminance),
      bounds_(bounds),
      axis_(desc.direction),
      turn_(desc.later_directions)
{}

Vec3 DirectionalLight::direction(float time) const
{
    return turn_.empty() ? direction_ : normalize(at_time(axis_, turn_, time));
}

EmissionSample DirectionalLight::sample_emission(Vec2 u_position, float time,
                                                 const EntryWindow& window) const
{
    const Vec3 direction = this->direction(time);
    const EntryWindow::Entry entry = window.sample(direction, u_position);
    return {.end = {.p = entry.p},
            .direction = direction,
            .weight = illuminance_ / entry.pdf.value,
            .pdf_position = {1.0f},
            .pdf_direction = {},
            .pdf_entry = entry.pdf};
}

IncidentSample DirectionalLight::sample_incident(const LightSampleContext& /*receiver*/, Vec2 /*u*/,
                                                 EnvironmentSampling /*sampling*/, float time) const
{
    return {.end = {},
            .wi = -direction(time),
            .distance = std::numeric_limits<float>::infinity(),
            .weight = illuminance_,
            .pdf = {1.0f},
            .pdf_solid_angle = {1.0f}};
}

Rgb DirectionalLight::power() const
{
    return illuminance_ / bounds_.pdf_disk().value;
}

}  // namespace bdpt
