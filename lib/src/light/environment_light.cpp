#include "light/environment_light.h"

#include "light/environment/cell_tables.h"
#include "light/learned/entries.h"
#include "math/elementary.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace bdpt {
namespace {

/// Returns the cosines of the polar angle at the edges of the image's rows.
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

/// Returns the fraction of the sphere in each row.
std::vector<float> row_shares(const std::vector<float>& cosines)
{
    std::vector<float> shares;
    for (std::size_t y = 0; y + 1 < cosines.size(); ++y) {
        shares.push_back(0.5f * (cosines[y] - cosines[y + 1]));
    }
    return shares;
}

/// Returns the texels of the image itself if they are compact.
std::shared_ptr<const EnvironmentTexels> shared_texels(const EnvironmentImage& image)
{
    return image.texels() ? image.texels()
                          : std::make_shared<const EnvironmentTexels>(*image.floats());
}

}  // namespace

EnvironmentLight::EnvironmentLight(const EnvironmentLightDesc& desc, const BoundingSphere& bounds)
    : world_from_environment_(desc.world_from_environment),
      bounds_(bounds),
      texels_(shared_texels(desc.radiance))
{
    CellWeights weights(*texels_, row_shares(row_cosines(height())));
    row_cosines_ = row_cosines(weights.rows());
    tiles_ = std::make_unique<const EnvironmentTiles>(EnvironmentWeights{
        .width = weights.columns(),
        .height = weights.rows(),
        .of_row = [&weights](int row, std::span<float> of_cells) { weights.of_row(row, of_cells); },
        .row_shares = row_shares(row_cosines_)});
}

/// Maps directions to the image: row 0 is around +y; the centre column is at -z and columns to the
/// right turn towards +x.
Vec2 EnvironmentLight::to_uv(Vec3 to_light) const
{
    const Vec3 d = transpose(world_from_environment_) * to_light;
    return {0.5f + atan2_exact(d.x, -d.z) * (0.5f * inv_pi), acos_exact(d.y) * inv_pi};
}

EnvironmentLight::Neighbours EnvironmentLight::neighbours(Vec2 uv) const
{
    const float x = uv.x * static_cast<float>(width()) - 0.5f;
    const float y = uv.y * static_cast<float>(height()) - 0.5f;
    const int x0 = floor_to_int(x);
    const int iy = floor_to_int(y);
    const int ix = std::clamp(x0, -1, width() - 1);
    return {.left = ix < 0 ? width() - 1 : ix,
            .right = ix + 1 < width() ? ix + 1 : 0,
            .upper = std::clamp(iy, 0, height() - 1),
            .lower = std::clamp(iy + 1, 0, height() - 1),
            .across = x - static_cast<float>(x0),
            .down = y - static_cast<float>(iy)};
}

Rgb EnvironmentLight::lookup(Vec2 uv) const
{
    const EnvironmentTexels& texels = *texels_;
    const auto [left, right, upper, lower, fx, fy] = neighbours(uv);
    return (1.0f - fy) * ((1.0f - fx) * texels(left, upper) + fx * texels(right, upper)) +
           fy * ((1.0f - fx) * texels(left, lower) + fx * texels(right, lower));
}

void EnvironmentLight::prefetch(Vec2 uv) const
{
    const Neighbours near = neighbours(uv);
    texels_->prefetch(near.left, near.upper);
    texels_->prefetch(near.left, near.lower);
}

Rgb EnvironmentLight::radiance(Vec3 to_light) const
{
    return lookup(to_uv(to_light));
}

/// Converts a density on the unit square, where all cells are equal, to directions: uniform in each
/// cell.
SolidAnglePdf EnvironmentLight::to_solid_angle(float pdf_square, int row) const
{
    const auto y = static_cast<std::size_t>(row);
    const float rise = (row_cosines_[y] - row_cosines_[y + 1]) * static_cast<float>(tiles_->rows());
    return {pdf_square / (2.0f * pi * rise)};
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
    const Vec2 uv = to_uv(to_light);
    return {.column = index(uv.x, tiles_->columns()), .row = index(uv.y, tiles_->rows())};
}

std::size_t EnvironmentLight::tile_to(Vec3 to_light) const
{
    const Cell cell = cell_to(to_light);
    return tiles_->find_tile(cell.column, cell.row);
}

SolidAnglePdf EnvironmentLight::pdf_direction_to(Vec3 to_light, const LightSampleContext& receiver,
                                                 EnvironmentSampling sampling) const
{
    const Cell cell = cell_to(to_light);
    return to_solid_angle(tiles_->pdf(cell.column, cell.row, in_image(receiver.normal),
                                      receiver.visibility, sampling),
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
    const auto cell = tiles_->sample(u, in_image(receiver.normal), receiver.visibility, sampling);
    return cell ? std::optional(direction_of(*cell)) : std::nullopt;
}

EnvironmentLight::Direction EnvironmentLight::direction_of(
    const EnvironmentTiles::Sample& cell) const
{
    const auto y = static_cast<std::size_t>(cell.row);
    const float cosine = row_cosines_[y] + cell.offset.y * (row_cosines_[y + 1] - row_cosines_[y]);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const float across =
        (static_cast<float>(cell.column) + cell.offset.x) / static_cast<float>(tiles_->columns());
    const SinCos phi = sin_cos(2.0f * pi * (across - 0.5f));
    const Vec3 local(sine * phi.sin, cosine, -sine * phi.cos);
    return {.to_light = normalize(world_from_environment_ * local),
            .uv = {across, acos_exact(cosine) * inv_pi},
            .pdf = to_solid_angle(cell.pdf, cell.row)};
}

EmissionSample EnvironmentLight::emission(const Direction& from, const EntryWindow& window,
                                          Vec2 u_position) const
{
    const EntryWindow::Entry entry = window.sample(-from.to_light, u_position);
    return {.end = {.p = entry.p},
            .direction = -from.to_light,
            .weight = lookup(from.uv) / (from.pdf.value * entry.pdf.value),
            .pdf_position = {from.pdf.value},
            .pdf_direction = {},
            .pdf_entry = entry.pdf};
}

std::optional<EmissionSample> EnvironmentLight::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float /*time*/) const
{
    const auto from = sample_direction(u_direction, {}, EnvironmentSampling::plain);
    return from ? std::optional(emission(*from, EntryWindow(bounds_), u_position)) : std::nullopt;
}

std::optional<EmissionSample> EnvironmentLight::sample_emission(
    Vec2 u_position, Vec2 u_direction, const EnvironmentEntries& entries) const
{
    const auto cell = tiles_->sample(u_direction, entries.worth(), EnvironmentSampling::plain);
    if (!cell) {
        return std::nullopt;
    }
    const Direction from = direction_of(*cell);
    return emission(from, entries.window(tile_to(from.to_light)), u_position);
}

EnvironmentLight::EntryPdfs EnvironmentLight::pdf_emission(Vec3 to_light, Vec3 p,
                                                           const EnvironmentEntries& entries) const
{
    const Cell cell = cell_to(to_light);
    const float pdf =
        tiles_->pdf(cell.column, cell.row, entries.worth(), EnvironmentSampling::plain);
    return {.direction = {to_solid_angle(pdf, cell.row).value},
            .entry = entries.window(tiles_->find_tile(cell.column, cell.row)).pdf(p, -to_light)};
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
    prefetch(from->uv);  // for `incident_weight`
    return IncidentSample{.end = {},
                          .barycentrics = from->uv,
                          .wi = from->to_light,
                          .distance = std::numeric_limits<float>::infinity(),
                          .weight = Rgb(1.0f / from->pdf.value),
                          .pdf = {from->pdf.value},
                          .pdf_solid_angle = from->pdf};
}

Rgb EnvironmentLight::power() const
{
    Rgb integral(0.0f);
    const std::vector<float> cosines = row_cosines(height());
    for (int y = 0; y < height(); ++y) {
        const auto row_index = static_cast<std::size_t>(y);
        Rgb row(0.0f);
        for (int x = 0; x < width(); ++x) {
            row += (*texels_)(x, y);
        }
        integral += (cosines[row_index] - cosines[row_index + 1]) * row;
    }
    const float texel_width = 2.0f * pi / static_cast<float>(width());
    return texel_width * integral / bounds_.pdf_disk().value;
}

}  // namespace bdpt
