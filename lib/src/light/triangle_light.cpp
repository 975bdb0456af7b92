#include "light/triangle_light.h"

#include "geometry/placed_mesh.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "math/low_level.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

constexpr int max_cells = 32;               // per side
constexpr float floor_of_triangle = 0.01f;  // fraction of the texture's mean
constexpr float floor_of_cell = 0.1f;       // fraction of the mean of the cells

/// Returns the longest edge of the triangle in texels.
float longest_edge(const PlacedMesh& mesh, const Material& material, std::uint32_t triangle)
{
    const auto a = mesh.uv(triangle, {0.0f, 0.0f});
    const auto b = mesh.uv(triangle, {1.0f, 0.0f});
    const auto c = mesh.uv(triangle, {0.0f, 1.0f});
    return std::max({material.emission_texels(a, b), material.emission_texels(a, c),
                     material.emission_texels(b, c)});
}

/// Rounds `wanted` up and clamps it to [least, most]; it may be infinite for large coordinates.
int clamped(float wanted, int least, int most)
{
    return wanted < static_cast<float>(most) ? std::max(static_cast<int>(std::ceil(wanted)), least)
                                             : most;
}

}  // namespace

TriangleEmission measure_emission(const PlacedMesh& mesh, const Material& material,
                                  std::uint32_t triangle, int max_samples)
{
    const bool colored = !mesh.mesh().colors.empty() && material.emission_needs_color();
    if (!material.emission_needs_texture() && !colored) {
        return {.mean = material.mean_emission(), .spread = nullptr};
    }
    const float edge = longest_edge(mesh, material, triangle);
    const int cells = clamped(edge, 1, std::clamp(max_samples / 2, 1, max_cells));
    constexpr float samples_per_texel = 3.0f;
    const int samples_per_cell = clamped(samples_per_texel * edge / static_cast<float>(cells), 2,
                                         std::max(2, max_samples / cells));
    const int samples = cells * samples_per_cell;

    Rgb total(0.0f);
    std::vector<double> squares(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    for (int y = 0; y < samples; ++y) {
        for (int x = 0; x < samples; ++x) {
            const Vec2 u = (Vec2(x, y) + 0.5f) / static_cast<float>(samples);
            const int cell = y / samples_per_cell * cells + x / samples_per_cell;
            const Rgb emitted =
                material.expected_emission(texture_point(mesh, triangle, square_to_triangle(u)));
            total += emitted;
            const auto bright = static_cast<double>(luminance(emitted));
            squares[static_cast<std::size_t>(cell)] += bright * bright;
        }
    }
    const auto cell_samples = static_cast<float>(samples_per_cell * samples_per_cell);
    TriangleEmission result{.mean = mix(total / (cell_samples * static_cast<float>(squares.size())),
                                        material.mean_emission(), floor_of_triangle),
                            .spread = nullptr};
    // The root mean square, rather than the mean, minimizes the variance in cells that are not
    // uniform.
    std::vector<float> weights;
    weights.reserve(squares.size());
    float sum = 0.0f;
    for (const double square : squares) {
        weights.push_back(
            static_cast<float>(std::sqrt(square / static_cast<double>(cell_samples))));
        sum += weights.back();
    }
    const float min_weight = floor_of_cell * sum / static_cast<float>(weights.size());
    for (float& weight : weights) {
        weight += min_weight;
    }
    const auto [least, greatest] = std::minmax_element(weights.begin(), weights.end());
    constexpr float hardly_more = 1.05f;
    if (*greatest > hardly_more * *least) {
        result.spread = std::make_shared<const Distribution2D>(weights, cells, cells);
    }
    return result;
}

TriangleLight::Facing TriangleLight::compute_facing(Vec3 area_normal)
{
    const float area = 0.5f * compute_length(area_normal);
    return {.area = area, .inverse_area = 1.0f / area, .ng = area_normal / (2.0f * area)};
}

TriangleLight::TriangleLight(const PlacedMesh& mesh, const Material& material,
                             std::uint32_t triangle, TriangleEmission emission)
    : mesh_(&mesh),
      material_(&material),
      triangle_(triangle),
      first_(compute_facing(mesh.area_normal(triangle, 0.0f))),
      mean_area_(mean_area()),
      emission_(std::move(emission))
{
    const bool colored = !mesh.mesh().colors.empty() && material.emission_needs_color();
    if (!material.emission_needs_texture() && !colored) {
        even_radiance_ = material.expected_emission({});
    }
}

TriangleLight::Facing TriangleLight::facing(float time) const
{
    return mesh_->moves() ? compute_facing(mesh_->area_normal(triangle_, time)) : first_;
}

float TriangleLight::mean_area() const
{
    // The area normal is a polynomial between two steps, so it cannot vanish at all of these.
    const std::size_t last = 4 * mesh_->steps();
    float sum = first_.area;
    for (std::size_t i = 1; i <= last; ++i) {
        sum += facing(static_cast<float>(i) / static_cast<float>(last)).area;
    }
    return sum / static_cast<float>(last + 1);
}

inline float TriangleLight::spread(Vec2 barycentrics) const
{
    return emission_.spread ? emission_.spread->pdf(triangle_to_square(barycentrics)) : 1.0f;
}

[[gnu::always_inline]] inline TriangleLight::Point TriangleLight::point_at(Vec2 barycentrics,
                                                                           float spread,
                                                                           const Facing& facing,
                                                                           float time) const
{
    const BoundedPoint at = mesh_->point(triangle_, barycentrics, time);
    const Rgb radiance =
        even_radiance_
            ? *even_radiance_
            : material_->expected_emission(texture_point(*mesh_, triangle_, barycentrics));
    return {.end = {.p = at.p, .error = at.error, .ng = facing.ng, .media = material_->media()},
            .barycentrics = barycentrics,
            .pdf = {spread * facing.inverse_area},
            .inverse_pdf = emission_.spread ? facing.area / spread : facing.area,
            .radiance = radiance};
}

[[gnu::always_inline]] inline TriangleLight::Point TriangleLight::point(Vec2 u,
                                                                        const Facing& facing,
                                                                        float time) const
{
    const Vec2 barycentrics =
        square_to_triangle(emission_.spread ? emission_.spread->sample(u).point : u);
    return point_at(barycentrics, spread(barycentrics), facing, time);
}

inline std::optional<SphericalTriangle> TriangleLight::seen_from(Vec3 p, const Facing& facing,
                                                                 float time) const
{
    // The points of a smaller one bring nearly the same light.
    constexpr float min_solid_angle = 0.03f;
    if (!even_radiance_) {
        return std::nullopt;
    }
    auto corners = mesh_->corners(triangle_, time);
    for (Vec3& corner : corners) {
        corner -= p;
    }
    const Vec3 center = (corners[0] + corners[1] + corners[2]) / 3.0f;
    const float distance2 = dot(center, center);
    const float height = std::abs(dot(facing.ng, center));
    if (!(facing.area * height > min_solid_angle * distance2 * std::sqrt(distance2))) {
        return std::nullopt;
    }
    const SphericalTriangle seen(corners);
    return seen.solid_angle() > min_solid_angle ? std::optional(seen) : std::nullopt;
}

std::optional<EmissionSample> TriangleLight::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                             float time) const
{
    const Facing facing = this->facing(time);
    if (!(facing.area > 0.0f)) {
        return std::nullopt;
    }
    const Point from = point(u_position, facing, time);
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
                          .weight = from.radiance * (pi * sides * from.inverse_pdf),
                          .pdf_position = from.pdf,
                          .pdf_direction = pdf_direction(side * local.z)};
}

std::optional<IncidentSample> TriangleLight::sample_incident(const LightSampleContext& receiver,
                                                             Vec2 u,
                                                             EnvironmentSampling /*sampling*/,
                                                             float time) const
{
    std::optional<IncidentSample> sampled;  // constructed in place of the result
    const Facing facing = this->facing(time);
    if (!(facing.area > 0.0f)) {
        return sampled;
    }
    const std::optional<SphericalTriangle> seen = seen_from(receiver.p, facing, time);
    const Point from = seen ? point_at(seen->barycentrics(seen->sample(u)), 1.0f, facing, time)
                            : point(u, facing, time);
    const Vec3 to_light = from.end.p - receiver.p;
    const float distance_squared = dot(to_light, to_light);
    const float distance = std::sqrt(distance_squared);
    const float inverse_distance = 1.0f / distance;
    const Vec3 wi = to_light * inverse_distance;
    const float cosine = dot(from.end.ng, -wi);
    const bool dark_side = cosine < 0.0f && !material_->emits_from_both_sides();
    if (!(distance_squared > 0.0f) || cosine == 0.0f || dark_side) {
        return sampled;
    }
    const float area_per_solid_angle = distance_squared / std::abs(cosine);
    const float geometry = std::abs(cosine) * (inverse_distance * inverse_distance);
    sampled.emplace(blank<IncidentSample>);
    sampled->end.p = from.end.p;
    sampled->end.error = from.end.error;
    sampled->end.ng = from.end.ng;
    sampled->end.media = from.end.media;
    sampled->barycentrics = from.barycentrics;
    sampled->wi = wi;
    sampled->distance = distance;
    if (seen) {
        sampled->weight = from.radiance * seen->solid_angle();
        sampled->pdf_solid_angle = {1.0f / seen->solid_angle()};
        sampled->pdf = {sampled->pdf_solid_angle.value * geometry};
    } else {
        sampled->weight = from.radiance * (geometry * from.inverse_pdf);
        sampled->pdf = from.pdf;
        sampled->pdf_solid_angle = {from.pdf.value * area_per_solid_angle};
    }
    return sampled;
}

AreaPdf TriangleLight::pdf_position(Vec2 barycentrics, const Facing& at) const
{
    return {spread(barycentrics) * at.inverse_area};
}

AreaPdf TriangleLight::pdf_position(const LightPoint& x0) const
{
    return pdf_position(x0.barycentrics, facing(x0.time));
}

AreaPdf TriangleLight::pdf_incident(const LightSampleContext& receiver, const LightPoint& x0,
                                    EnvironmentSampling /*sampling*/) const
{
    const Facing facing = this->facing(x0.time);
    const std::optional<SphericalTriangle> seen = seen_from(receiver.p, facing, x0.time);
    if (!seen) {
        return pdf_position(x0.barycentrics, facing);
    }
    const Vec3 to_light = x0.p - receiver.p;
    const float distance2 = dot(to_light, to_light);
    const float cosine = std::abs(dot(facing.ng, to_light)) / std::sqrt(distance2);
    return to_area({1.0f / seen->solid_angle()}, cosine, distance2);
}

SolidAnglePdf TriangleLight::pdf_direction(Vec3 ng, Vec3 direction, float /*time*/) const
{
    return pdf_direction(dot(ng, direction));
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
    return emission_.mean * (pi * mean_area_ * sides);
}

LightBounds TriangleLight::bounds() const
{
    auto corners = mesh_->corners(triangle_, 0.0f);
    const bool two_sided = material_->emits_from_both_sides();
    LightBounds result{.min = min(min(corners[0], corners[1]), corners[2]),
                       .max = max(max(corners[0], corners[1]), corners[2]),
                       .normals = {.axis = first_.ng, .cos_angle = 1.0f},
                       .cos_falloff = 0.0f,
                       .sides = two_sided ? EmittingSides::both : EmittingSides::front,
                       .intensity = static_cast<double>(luminance(emission_.mean) * mean_area_)};
    if (!mesh_->moves()) {
        return result;
    }
    result.normals = {};
    // Between two steps a vertex moves along a parabola at most, within its three control points.
    const auto steps = static_cast<float>(mesh_->steps());
    for (std::size_t step = 1; step <= mesh_->steps(); ++step) {
        const auto end = static_cast<float>(step);
        const auto halfway = mesh_->corners(triangle_, (end - 0.5f) / steps);
        const auto next = mesh_->corners(triangle_, end / steps);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            result.contain(next[i]);
            result.contain(2.0f * halfway[i] - 0.5f * (corners[i] + next[i]));
        }
        corners = next;
    }
    return result;
}

}  // namespace bdpt
