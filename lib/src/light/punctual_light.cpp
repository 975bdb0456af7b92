#include "light/punctual_light.h"

#include "math/rgb.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

PunctualLight::PunctualLight(const PointLightDesc& desc)
    : position_(desc.position), intensity_(desc.intensity)
{}

PunctualLight::PunctualLight(const SpotLightDesc& desc)
    : position_(desc.position),
      intensity_(desc.intensity),
      cone_(desc.direction, desc.inner_cone_angle, desc.outer_cone_angle)
{}

EmissionSample PunctualLight::sample_emission(Vec2 u) const
{
    const Vec3 direction = cone_.sample(u);
    const float omega = cone_.solid_angle();
    return {.end = {.p = position_},
            .direction = direction,
            .weight = intensity_ * (cone_.falloff(direction) * omega),
            .pdf_position = {1.0f},
            .pdf_direction = {1.0f / omega}};
}

std::optional<IncidentSample> PunctualLight::sample_incident(Vec3 receiver) const
{
    const Vec3 to_light = position_ - receiver;
    const float distance_squared = dot(to_light, to_light);
    if (!(distance_squared > 0.0f)) {
        return std::nullopt;
    }
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float attenuation = cone_.falloff(-wi);
    if (attenuation == 0.0f) {
        return std::nullopt;
    }
    return IncidentSample{.end = {.p = position_},
                          .wi = wi,
                          .distance = distance,
                          .weight = intensity_ * (attenuation / distance_squared),
                          .pdf = {1.0f},
                          .pdf_solid_angle = {1.0f}};
}

LightBounds PunctualLight::bounds() const
{
    return {.min = position_,
            .max = position_,
            .normals = cone_.full(),
            .cos_falloff = cone_.cos_falloff(),
            .intensity = static_cast<double>(luminance(intensity_))};
}

}  // namespace bdpt
