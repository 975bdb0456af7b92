#include "light/punctual_light.h"

#include "geometry/motion.h"
#include "light/point_emission.h"
#include "math/rgb.h"

namespace bdpt {

PunctualLight::PunctualLight(const PointLightDesc& desc)
    : position_(desc.position), intensity_(desc.intensity), motion_(desc.motion)
{}

PunctualLight::PunctualLight(const SpotLightDesc& desc)
    : position_(desc.position),
      intensity_(desc.intensity),
      cone_(desc.direction, desc.inner_cone_angle, desc.outer_cone_angle),
      axis_(desc.direction),
      motion_(desc.motion),
      turn_(desc.later_directions)
{}

Vec3 PunctualLight::position(float time) const
{
    return at_time(position_, motion_, time);
}

SpotCone PunctualLight::cone(float time) const
{
    return turn_.empty() ? cone_ : cone_.around(at_time(axis_, turn_, time));
}

EmissionSample PunctualLight::sample_emission(Vec2 /*u_position*/, Vec2 u_direction,
                                              float time) const
{
    const SpotCone cone = this->cone(time);
    const Vec3 direction = cone.sample(u_direction);
    const float omega = cone.solid_angle();
    return {.end = {.p = position(time)},
            .direction = direction,
            .weight = intensity_ * (cone.falloff(direction) * omega),
            .pdf_position = {1.0f},
            .pdf_direction = {1.0f / omega}};
}

std::optional<IncidentSample> PunctualLight::sample_incident(const LightSampleContext& receiver,
                                                             Vec2 /*u*/,
                                                             EnvironmentSampling /*sampling*/,
                                                             float time) const
{
    return incident_from_point(position(time), receiver.p, intensity_,
                               [&](Vec3 from) { return cone(time).falloff(from); });
}

LightBounds PunctualLight::bounds() const
{
    LightBounds result{.min = position_,
                       .max = position_,
                       .normals = turn_.empty() ? cone_.full() : DirectionCone{},
                       .cos_falloff = cone_.cos_falloff(),
                       .intensity = static_cast<double>(luminance(intensity_))};
    for (const Vec3 later : motion_) {
        result.contain(later);
    }
    return result;
}

}  // namespace bdpt
