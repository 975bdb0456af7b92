#include "light/sphere_light.h"

#include "geometry/motion.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {
namespace {

/// A sphere as seen from a point outside of it.
struct View {
    Vec3 axis{0.0f};             // unit, towards the centre
    double distance = 0.0;       // distance of the centre, in radii
    double excess = 0.0;         // distance^2 - 1
    float one_minus_cos = 0.0f;  // 1 - cos of the half angle

    [[nodiscard]] SolidAnglePdf pdf() const { return cone_pdf(one_minus_cos); }
};

/// Returns nullopt from inside, and for a sphere so small that its solid angle is no normal float.
std::optional<View> view_from(Vec3 receiver, const Sphere& sphere)
{
    // In double, to keep the excess of a point that nearly touches the sphere precise.
    const glm::dvec3 to_center =
        (glm::dvec3(sphere.center) - glm::dvec3(receiver)) / static_cast<double>(sphere.radius);
    const double distance_squared = dot(to_center, to_center);
    const double excess = distance_squared - 1.0;
    if (!(excess > 0.0)) {
        return std::nullopt;
    }
    const double distance = std::sqrt(distance_squared);
    const double cosine = std::sqrt(excess) / distance;
    const auto one_minus_cos = static_cast<float>(1.0 / (distance_squared * (1.0 + cosine)));
    if (!(one_minus_cos >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return View{.axis = Vec3(to_center / distance),
                .distance = distance,
                .excess = excess,
                .one_minus_cos = one_minus_cos};
}

/// Samples the normal at the hit of a ray whose direction is uniform in the cone.
Vec3 sample_visible_normal(const View& view, Vec2 u)
{
    const Vec3 w = square_to_cone(u, view.one_minus_cos);
    const double sine_squared = static_cast<double>(w.x * w.x + w.y * w.y);
    // Distance of the hit in radii; written as a ratio, because it may be small.
    const double chord = std::max(0.0, 1.0 - view.distance * view.distance * sine_squared);
    const double t = view.excess / (view.distance * static_cast<double>(w.z) + std::sqrt(chord));
    const auto x = static_cast<float>(static_cast<double>(w.x) * t);
    const auto y = static_cast<float>(static_cast<double>(w.y) * t);
    const Frame frame = Frame::from_normal(view.axis);
    const float towards = std::sqrt(std::max(0.0f, 1.0f - x * x - y * y));
    return normalize(x * frame.x + y * frame.y - towards * frame.z);
}

}  // namespace

SphereLight::SphereLight(const PointLightDesc& desc, std::uint32_t number)
    : sphere_{.center = desc.position, .radius = desc.radius, .motion = desc.motion},
      number_(number),
      intensity_(desc.intensity)
{}

SphereLight::SphereLight(const SpotLightDesc& desc, std::uint32_t number)
    : sphere_{.center = desc.position, .radius = desc.radius, .motion = desc.motion},
      number_(number),
      intensity_(desc.intensity),
      cone_(desc.direction, desc.inner_cone_angle, desc.outer_cone_angle),
      axis_(desc.direction),
      turn_(desc.later_directions)
{}

SpotCone SphereLight::cone(float time) const
{
    return turn_.empty() ? cone_ : cone_.around(at_time(axis_, turn_, time));
}

SegmentEnd SphereLight::surface(Vec3 ng, float time) const
{
    const BoundedPoint at = sphere_.at(time).point(ng);
    return {.p = at.p, .error = at.error, .ng = ng, .sphere = number_};
}

Rgb SphereLight::radiance(Vec3 direction, float time) const
{
    return intensity_ * (cone(time).falloff(direction) / (pi * sphere_.radius * sphere_.radius));
}

std::optional<EmissionSample> SphereLight::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                           float time) const
{
    const SpotCone cone = this->cone(time);
    const Vec3 direction = cone.sample(u_direction);
    const Vec3 on_disk = square_to_cosine_hemisphere(u_position);
    if (on_disk.z <= 0.0f) {
        return std::nullopt;
    }
    const Vec3 ng = Frame::from_normal(direction).to_world(on_disk);
    // Le cos / (cos / (pi r^2) / solid angle): the cosine and the disk cancel.
    return EmissionSample{.end = surface(ng, time),
                          .direction = direction,
                          .weight = intensity_ * (cone.falloff(direction) * cone.solid_angle()),
                          .pdf_position = pdf_position(),
                          .pdf_direction = {4.0f * on_disk.z / cone.solid_angle()}};
}

std::optional<IncidentSample> SphereLight::sample_incident(const LightSampleContext& receiver,
                                                           Vec2 u, EnvironmentSampling /*sampling*/,
                                                           float time) const
{
    const auto view = view_from(receiver.p, sphere_.at(time));
    if (!view) {
        return std::nullopt;
    }
    const SegmentEnd end = surface(sample_visible_normal(*view, u), time);
    const Vec3 to_light = end.p - receiver.p;
    const float distance_squared = dot(to_light, to_light);
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float cosine = -dot(end.ng, wi);
    const Rgb radiance = this->radiance(-wi, time);
    if (!(distance_squared > 0.0f) || !(cosine > 0.0f) || is_black(radiance)) {
        return std::nullopt;
    }
    return IncidentSample{.end = end,
                          .wi = wi,
                          .distance = distance,
                          .weight = radiance / view->pdf().value,
                          .pdf = to_area(view->pdf(), cosine, distance_squared),
                          .pdf_solid_angle = view->pdf()};
}

AreaPdf SphereLight::pdf_position(const LightPoint& /*x0*/) const
{
    return {0.25f * inv_pi / (sphere_.radius * sphere_.radius)};
}

AreaPdf SphereLight::pdf_incident(const LightSampleContext& receiver, const LightPoint& x0,
                                  EnvironmentSampling /*sampling*/) const
{
    const auto view = view_from(receiver.p, sphere_.at(x0.time));
    const Vec3 to_light = x0.p - receiver.p;
    const float distance_squared = dot(to_light, to_light);
    const float cosine = -dot(x0.ng, to_light / std::sqrt(distance_squared));
    if (!view || !(cosine > 0.0f)) {
        return {0.0f};
    }
    return to_area(view->pdf(), cosine, distance_squared);
}

SolidAnglePdf SphereLight::pdf_direction(Vec3 ng, Vec3 direction, float time) const
{
    return {4.0f * std::max(0.0f, dot(ng, direction)) * cone(time).pdf(direction).value};
}

LightBounds SphereLight::bounds() const
{
    LightBounds result{.min = sphere_.center - sphere_.radius,
                       .max = sphere_.center + sphere_.radius,
                       .normals = turn_.empty() ? cone_.full() : DirectionCone{},
                       .cos_falloff = cone_.cos_falloff(),
                       .intensity = static_cast<double>(luminance(intensity_))};
    for (const Vec3 later : sphere_.motion) {
        result.contain(later - sphere_.radius);
        result.contain(later + sphere_.radius);
    }
    return result;
}

}  // namespace bdpt
