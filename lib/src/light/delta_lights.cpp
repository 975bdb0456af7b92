#include "light/delta_lights.h"

#include "geometry/motion.h"
#include "light/point_emission.h"
#include "math/rgb.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <limits>

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

ProfileLight::ProfileLight(const ProfileLightDesc& desc, const IntensityProfile& profile)
    : profile_(&profile),
      position_(desc.position),
      motion_(desc.motion),
      world_from_light_(desc.world_from_light),
      scale_(desc.scale)
{}

Vec3 ProfileLight::to_local(Vec3 direction) const
{
    return transpose(world_from_light_) * direction;
}

std::optional<EmissionSample> ProfileLight::sample_emission(Vec2 /*u_position*/, Vec2 u_direction,
                                                            float time) const
{
    const auto from = profile_->sample(u_direction);
    if (!from) {
        return std::nullopt;
    }
    return EmissionSample{.end = {.p = at_time(position_, motion_, time)},
                          .direction = normalize(world_from_light_ * from->direction),
                          .weight = scale_ * (from->intensity / from->pdf.value),
                          .pdf_position = {1.0f},
                          .pdf_direction = from->pdf};
}

std::optional<IncidentSample> ProfileLight::sample_incident(const LightSampleContext& receiver,
                                                            Vec2 /*u*/,
                                                            EnvironmentSampling /*sampling*/,
                                                            float time) const
{
    return incident_from_point(at_time(position_, motion_, time), receiver.p, scale_,
                               [this](Vec3 from) { return profile_->intensity(to_local(from)); });
}

SolidAnglePdf ProfileLight::pdf_direction(Vec3 /*ng*/, Vec3 direction, float /*time*/) const
{
    return profile_->pdf(to_local(direction));
}

LightBounds ProfileLight::bounds() const
{
    LightBounds result{.min = position_,
                       .max = position_,
                       .normals = {},
                       .cos_falloff = 1.0f,
                       .intensity = static_cast<double>(luminance(scale_) * profile_->peak())};
    for (const Vec3 later : motion_) {
        result.contain(later);
    }
    return result;
}

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
