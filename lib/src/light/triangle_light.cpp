#include "light/triangle_light.h"

#include "math/elementary.h"
#include "math/frame.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

TriangleLight::TriangleLight(const PlacedMesh& mesh, const Material& material,
                             std::uint32_t triangle, int most_samples)
    : mesh_(&mesh),
      material_(&material),
      triangle_(triangle),
      emission_(measure_emission(mesh, material, triangle, most_samples))
{
    const Vec3 normal = mesh.area_normal(triangle);
    area_ = 0.5f * std::sqrt(dot(normal, normal));
    ng_ = normal / (2.0f * area_);
}

TriangleLight::Point TriangleLight::point(Vec2 u) const
{
    const Vec2 barycentrics =
        square_to_triangle(emission_.spread ? emission_.spread->sample(u).point : u);
    const BoundedPoint at = mesh_->point(triangle_, barycentrics);
    return {
        .end = {.p = at.p, .error = at.error, .ng = ng_, .media = material_->media()},
        .barycentrics = barycentrics,
        .pdf = pdf_position(barycentrics),
        .radiance = material_->expected_emission(texture_point(*mesh_, triangle_, barycentrics))};
}

std::optional<EmissionSample> TriangleLight::sample_emission(Vec2 u_position,
                                                             Vec2 u_direction) const
{
    const Point from = point(u_position);
    const bool two_sided = material_->emits_from_both_sides();
    float side = 1.0f;
    if (two_sided) {
        side = u_direction.x < 0.5f ? 1.0f : -1.0f;
        u_direction.x = 2.0f * u_direction.x - (side > 0.0f ? 0.0f : 1.0f);
    }
    const Vec3 local = square_to_cosine_hemisphere(u_direction);
    if (local.z <= 0.0f) {
        return std::nullopt;
    }
    // Le cos / (pdf * cos/pi): the cosine cancels.
    const float sides = two_sided ? 2.0f : 1.0f;
    return EmissionSample{.end = from.end,
                          .barycentrics = from.barycentrics,
                          .direction = Frame::from_normal(side * from.end.ng).to_world(local),
                          .weight = from.radiance * (pi * sides / from.pdf.value),
                          .pdf_position = from.pdf,
                          .pdf_direction = pdf_direction(side * local.z)};
}

std::optional<IncidentSample> TriangleLight::sample_incident(Vec3 receiver, Vec2 u) const
{
    const Point from = point(u);
    const Vec3 to_light = from.end.p - receiver;
    const float distance_squared = dot(to_light, to_light);
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float cosine = dot(from.end.ng, -wi);
    const bool dark_side = cosine < 0.0f && !material_->emits_from_both_sides();
    if (!(distance_squared > 0.0f) || cosine == 0.0f || dark_side) {
        return std::nullopt;
    }
    const float geometry = std::abs(cosine) / distance_squared;
    return IncidentSample{.end = from.end,
                          .barycentrics = from.barycentrics,
                          .wi = wi,
                          .distance = distance,
                          .weight = from.radiance * (geometry / from.pdf.value),
                          .pdf = from.pdf,
                          .pdf_solid_angle = {from.pdf.value / geometry}};
}

AreaPdf TriangleLight::pdf_position(Vec2 barycentrics) const
{
    const float spread =
        emission_.spread ? emission_.spread->pdf(triangle_to_square(barycentrics)) : 1.0f;
    return {spread / area_};
}

SolidAnglePdf TriangleLight::pdf_direction(float cosine) const
{
    if (material_->emits_from_both_sides()) {
        return {std::abs(cosine) * (0.5f * inv_pi)};
    }
    return {cosine > 0.0f ? cosine * inv_pi : 0.0f};
}

Rgb TriangleLight::power() const
{
    const float sides = material_->emits_from_both_sides() ? 2.0f : 1.0f;
    return emission_.mean * (pi * area_ * sides);
}

}  // namespace bdpt
