#include "light/punctual_light.h"

#include "math/elementary.h"
#include "math/frame.h"
#include "math/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// 1 - cos(angle) without the loss of digits for small angles.
float cone_height(float angle)
{
    const float s = sin_cos(0.5f * angle).sin;
    return 2.0f * s * s;
}

}  // namespace

PunctualLight::PunctualLight(const PointLightDesc& desc)
    : position_(desc.position), intensity_(desc.intensity)
{}

PunctualLight::PunctualLight(const SpotLightDesc& desc)
    : position_(desc.position),
      axis_(normalize(desc.direction)),
      intensity_(desc.intensity),
      cos_inner_(1.0f - cone_height(desc.inner_cone_angle)),
      one_minus_cos_outer_(cone_height(desc.outer_cone_angle))
{}

float PunctualLight::solid_angle() const
{
    return 2.0f * pi * one_minus_cos_outer_;
}

/// Angular attenuation [KHR_lights_punctual, "Inner and Outer Cone Angles"].
float PunctualLight::falloff(Vec3 direction) const
{
    if (one_minus_cos_outer_ >= 2.0f) {
        return 1.0f;
    }
    const float cos_outer = 1.0f - one_minus_cos_outer_;
    const float range = std::max(cos_inner_ - cos_outer, 1e-6f);  // avoids 0/0 for a hard edge
    const float x = std::clamp((dot(axis_, direction) - cos_outer) / range, 0.0f, 1.0f);
    return x * x;
}

EmissionSample PunctualLight::sample_emission(Vec2 u) const
{
    const Vec3 direction =
        Frame::from_normal(axis_).to_world(square_to_cone(u, one_minus_cos_outer_));
    const float omega = solid_angle();
    return {.end = {.p = position_},
            .direction = direction,
            .weight = intensity_ * (falloff(direction) * omega),
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
    const float attenuation = falloff(-wi);
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

SolidAnglePdf PunctualLight::pdf_direction(Vec3 direction) const
{
    const bool inside =
        one_minus_cos_outer_ >= 2.0f || dot(axis_, direction) >= 1.0f - one_minus_cos_outer_;
    return {inside ? 1.0f / solid_angle() : 0.0f};
}

Rgb PunctualLight::power() const
{
    // The squared linear ramp between the cones has a third of the flux of the full intensity.
    if (one_minus_cos_outer_ >= 2.0f) {
        return intensity_ * (4.0f * pi);
    }
    const float one_minus_cos_inner = 1.0f - cos_inner_;
    const float ramp = one_minus_cos_outer_ - one_minus_cos_inner;
    return intensity_ * (2.0f * pi * (one_minus_cos_inner + ramp / 3.0f));
}

}  // namespace bdpt
