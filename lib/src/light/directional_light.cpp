#include "light/directional_light.h"

#include "light/parallel_rays.h"

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {

DirectionalLight::DirectionalLight(const DirectionalLightDesc& desc, const BoundingSphere& bounds)
    : direction_(normalize(desc.direction)), illuminance_(desc.illuminance), bounds_(bounds)
{}

EmissionSample DirectionalLight::sample_emission(Vec2 u) const
{
    return {.end = {.p = sample_entry(bounds_, direction_, u)},
            .direction = direction_,
            .weight = illuminance_ / bounds_.pdf_disk().value,
            .pdf_position = {1.0f},
            .pdf_direction = {}};
}

IncidentSample DirectionalLight::sample_incident() const
{
    return {.end = {},
            .wi = -direction_,
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
