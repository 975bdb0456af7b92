#include "light/point_emission.h"

#include "math/elementary.h"
#include "math/frame.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// Returns 1 - cos(angle), precise for small angles.
float cone_height(float angle)
{
    const float s = sin_cos(0.5f * angle).sin;
    return 2.0f * s * s;
}

}  // namespace

SpotCone::SpotCone(Vec3 axis, float inner_angle, float outer_angle)
    : axis_(normalize(axis)),
      cos_inner_(1.0f - cone_height(inner_angle)),
      one_minus_cos_outer_(cone_height(outer_angle))
{}

SpotCone SpotCone::around(Vec3 axis) const
{
    SpotCone result = *this;
    result.axis_ = normalize(axis);
    return result;
}

Vec3 SpotCone::sample(Vec2 u) const
{
    return Frame::from_normal(axis_).to_world(square_to_cone(u, one_minus_cos_outer_));
}

SolidAnglePdf SpotCone::pdf(Vec3 direction) const
{
    const bool inside = is_whole() || dot(axis_, direction) >= 1.0f - one_minus_cos_outer_;
    return {inside ? 1.0f / solid_angle() : 0.0f};
}

float SpotCone::falloff(Vec3 direction) const
{
    if (is_whole()) {
        return 1.0f;
    }
    const float cos_outer = 1.0f - one_minus_cos_outer_;
    const float range = std::max(cos_inner_ - cos_outer, 1e-6f);  // avoids 0/0 for a hard edge
    const float x = std::clamp((dot(axis_, direction) - cos_outer) / range, 0.0f, 1.0f);
    return x * x;
}

float SpotCone::solid_angle() const
{
    return 2.0f * pi * one_minus_cos_outer_;
}

float SpotCone::cos_falloff() const
{
    const auto sine = [](float one_minus_cos) {
        return std::sqrt(std::max(0.0f, one_minus_cos * (2.0f - one_minus_cos)));
    };
    const float cos_outer = 1.0f - one_minus_cos_outer_;
    return cos_outer * cos_inner_ + sine(one_minus_cos_outer_) * sine(1.0f - cos_inner_);
}

float SpotCone::integral() const
{
    if (is_whole()) {
        return 4.0f * pi;
    }
    // The squared linear ramp between the cones has a third of the flux of the full intensity.
    const float one_minus_cos_inner = 1.0f - cos_inner_;
    const float ramp = one_minus_cos_outer_ - one_minus_cos_inner;
    return 2.0f * pi * (one_minus_cos_inner + ramp / 3.0f);
}

}  // namespace bdpt
