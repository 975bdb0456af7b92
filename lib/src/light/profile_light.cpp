#include "light/profile_light.h"

#include "geometry/motion.h"
#include "light/point_emission.h"
#include "math/rgb.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace bdpt {

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

}  // namespace bdpt
