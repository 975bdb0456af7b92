#include "light/environment_light.h"

#include "light/parallel_rays.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bdpt {
namespace {

/// Cosines of the polar angle at the edges of the image's rows.
std::vector<float> row_cosines(int height)
{
    std::vector<float> cosines;
    for (int y = 0; y <= height; ++y) {
        cosines.push_back(sin_cos(pi * static_cast<float>(y) / static_cast<float>(height)).cos);
    }
    cosines.front() = 1.0f;
    cosines.back() = -1.0f;
    return cosines;
}

/// How much each texel is sampled: by its own luminance and that of its neighbours, for bilinear
/// lookups carry light over the edge, times its solid angle (up to a constant).
std::vector<float> sampling_weights(const Image& image, const std::vector<float>& cosines)
{
    std::vector<float> weights;
    weights.reserve(image.pixels.size());
    for (int y = 0; y < image.height; ++y) {
        const auto row_index = static_cast<std::size_t>(y);
        const float solid_angle = cosines[row_index] - cosines[row_index + 1];
        for (int x = 0; x < image.width; ++x) {
            float sum = 0.0f;
            for (int dy = -1; dy <= 1; ++dy) {
                const int row = std::clamp(y + dy, 0, image.height - 1);
                for (int dx = -1; dx <= 1; ++dx) {
                    const int column = (x + dx + image.width) % image.width;
                    sum += luminance(image.at(column, row)) * (dx == 0 && dy == 0 ? 4.0f : 1.0f);
                }
            }
            weights.push_back(sum * solid_angle);
        }
    }
    return weights;
}

/// What is left of the weights above half of their mean, after Karlik et al. (2019), who take off
/// all of it; docs/decisions/0023 says why half. A constant image keeps its shape.
std::vector<float> compensated(const std::vector<float>& weights, int width,
                               const std::vector<float>& cosines)
{
    double sum = 0.0;
    for (const float weight : weights) {
        sum += static_cast<double>(weight);
    }
    // The solid angles of all texels, in the unit of the weights, add up to 2 for each column.
    const double mean = sum / (2.0 * static_cast<double>(width));
    std::vector<float> excess;
    excess.reserve(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const std::size_t row = i / static_cast<std::size_t>(width);
        const double solid_angle = static_cast<double>(cosines[row] - cosines[row + 1]);
        const double above = static_cast<double>(weights[i]) - 0.5 * mean * solid_angle;
        excess.push_back(static_cast<float>(std::max(above, 0.0)));
    }
    return excess;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const EnvironmentLightDesc& desc, const BoundingSphere& bounds)
    : image_(desc.radiance),
      world_from_environment_(desc.world_from_environment),
      bounds_(bounds),
      row_cosines_(row_cosines(image_.height))
{
    const std::vector<float> weights = sampling_weights(image_, row_cosines_);
    plain_ = std::make_unique<const EnvironmentTiles>(weights, image_.width, image_.height);
    compensated_ = std::make_unique<const EnvironmentTiles>(
        compensated(weights, image_.width, row_cosines_), image_.width, image_.height);
}

/// Row 0 is around +y; the centre column is at -z and columns to the right turn towards +x.
Vec2 EnvironmentLight::uv_of(Vec3 to_light) const
{
    const Vec3 d = transpose(world_from_environment_) * to_light;
    return {0.5f + atan2_exact(d.x, -d.z) * (0.5f * inv_pi), acos_exact(d.y) * inv_pi};
}

const Rgb& EnvironmentLight::texel(int x, int y) const
{
    const int column = x < 0 ? x + image_.width : x >= image_.width ? x - image_.width : x;
    return image_.at(column, std::clamp(y, 0, image_.height - 1));
}

Rgb EnvironmentLight::lookup(Vec2 uv) const
{
    const float x = uv.x * static_cast<float>(image_.width) - 0.5f;
    const float y = uv.y * static_cast<float>(image_.height) - 0.5f;
    const float x0 = std::floor(x);
    const float y0 = std::floor(y);
    const float fx = x - x0;
    const float fy = y - y0;
    const int ix = std::clamp(static_cast<int>(x0), -1, image_.width - 1);
    const int iy = static_cast<int>(y0);
    return (1.0f - fy) * ((1.0f - fx) * texel(ix, iy) + fx * texel(ix + 1, iy)) +
           fy * ((1.0f - fx) * texel(ix, iy + 1) + fx * texel(ix + 1, iy + 1));
}

Rgb EnvironmentLight::radiance(Vec3 to_light) const
{
    return lookup(uv_of(to_light));
}

/// From the unit square, where all texels are equal, to directions: uniform in each texel.
SolidAnglePdf EnvironmentLight::to_solid_angle(float pdf_square, int row) const
{
    const auto y = static_cast<std::size_t>(row);
    const float height =
        (row_cosines_[y] - row_cosines_[y + 1]) * static_cast<float>(image_.height);
    return {pdf_square / (2.0f * pi * height)};
}

std::optional<Vec3> EnvironmentLight::in_image(const std::optional<Vec3>& normal) const
{
    return normal ? std::optional(transpose(world_from_environment_) * *normal) : std::nullopt;
}

EnvironmentLight::Cell EnvironmentLight::cell_to(Vec3 to_light) const
{
    const auto index = [](float at, int size) {
        return std::clamp(static_cast<int>(at * static_cast<float>(size)), 0, size - 1);
    };
    const Vec2 uv = uv_of(to_light);
    return {.column = index(uv.x, plain_->columns()), .row = index(uv.y, image_.height)};
}

std::size_t EnvironmentLight::tile_to(Vec3 to_light) const
{
    const Cell cell = cell_to(to_light);
    return plain_->tile_of(cell.column, cell.row);
}

SolidAnglePdf EnvironmentLight::pdf_direction_to(Vec3 to_light, const LightSampleContext& receiver,
                                                 EnvironmentSampling sampling) const
{
    const Cell cell = cell_to(to_light);
    return to_solid_angle(
        tiles(sampling).pdf(cell.column, cell.row, in_image(receiver.normal), receiver.visibility),
        cell.row);
}

AreaPdf EnvironmentLight::pdf_incident(const LightSampleContext& receiver, const LightPoint& x0,
                                       EnvironmentSampling sampling) const
{
    return {pdf_direction_to(x0.p, receiver, sampling).value};
}

AreaPdf EnvironmentLight::pdf_position(const LightPoint& x0) const
{
    return {pdf_direction_to(x0.p, {}, EnvironmentSampling::plain).value};
}

std::optional<EnvironmentLight::Direction> EnvironmentLight::sample_direction(
    Vec2 u, const LightSampleContext& receiver, EnvironmentSampling sampling) const
{
    const EnvironmentTiles& tiles = this->tiles(sampling);
    const auto cell = tiles.sample(u, in_image(receiver.normal), receiver.visibility);
    if (!cell) {
        return std::nullopt;
    }
    const auto y = static_cast<std::size_t>(cell->row);
    const float cosine = row_cosines_[y] + cell->offset.y * (row_cosines_[y + 1] - row_cosines_[y]);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const float across =
        (static_cast<float>(cell->column) + cell->offset.x) / static_cast<float>(tiles.columns());
    const SinCos phi = sin_cos(2.0f * pi * (across - 0.5f));
    const Vec3 local(sine * phi.sin, cosine, -sine * phi.cos);
    return Direction{.to_light = normalize(world_from_environment_ * local),
                     .radiance = lookup({across, acos_exact(cosine) * inv_pi}),
                     .pdf = to_solid_angle(cell->pdf, cell->row)};
}

std::optional<EmissionSample> EnvironmentLight::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float /*time*/) const
{
    const auto from = sample_direction(u_direction, {}, EnvironmentSampling::plain);
    if (!from) {
        return std::nullopt;
    }
    return EmissionSample{.end = {.p = sample_entry(bounds_, -from->to_light, u_position)},
                          .direction = -from->to_light,
                          .weight = from->radiance / (from->pdf.value * bounds_.pdf_disk().value),
                          .pdf_position = {from->pdf.value},
                          .pdf_direction = {}};
}

std::optional<IncidentSample> EnvironmentLight::sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float /*time*/) const
{
    const auto from = sample_direction(u, receiver, sampling);
    if (!from) {
        return std::nullopt;
    }
    return IncidentSample{.end = {},
                          .wi = from->to_light,
                          .distance = std::numeric_limits<float>::infinity(),
                          .weight = from->radiance / from->pdf.value,
                          .pdf = {from->pdf.value},
                          .pdf_solid_angle = from->pdf};
}

Rgb EnvironmentLight::power() const
{
    Rgb integral(0.0f);
    for (int y = 0; y < image_.height; ++y) {
        const auto row_index = static_cast<std::size_t>(y);
        Rgb row(0.0f);
        for (int x = 0; x < image_.width; ++x) {
            row += image_.at(x, y);
        }
        integral += (row_cosines_[row_index] - row_cosines_[row_index + 1]) * row;
    }
    const float texel_width = 2.0f * pi / static_cast<float>(image_.width);
    return texel_width * integral / bounds_.pdf_disk().value;
}

}  // namespace bdpt
