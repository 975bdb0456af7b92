#include "light/intensity_profile.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace bdpt {
namespace {

constexpr float turn = 2.0f * pi;
// Tolerance for angles converted from degrees.
constexpr float rounding = 1e-5f;  // [rad]
// Cells are so narrow that intensities vary little within one, even in a coarse grid.
constexpr float max_cell_height = 2.0f * pi / 180.0f;
constexpr float widest_cell = 6.0f * pi / 180.0f;
// Limits memory to some megabytes; a grid that is fine in one angle only would get too many.
constexpr std::size_t usual_cells = std::size_t{1} << 18;
// Uniform part over all cells that are not dark: rounding cannot make a density zero there.
constexpr double even_share = 1e-3;

/// Returns 1 - cos(angle).
float to_height(float angle)
{
    const float s = sin_cos(0.5f * angle).sin;
    return angle >= pi - rounding ? 2.0f : 2.0f * s * s;
}

/// Returns the angle with that height.
float to_polar_angle(float height)
{
    return atan2_exact(std::sqrt(std::max(0.0f, height * (2.0f - height))), 1.0f - height);
}

/// Returns the angles, subdivided where they are more than `step` apart.
std::vector<float> refine(const std::vector<float>& angles, float step)
{
    std::vector<float> edges{angles.front()};
    for (std::size_t i = 1; i < angles.size(); ++i) {
        const float width = angles[i] - angles[i - 1];
        const int parts = std::max(1, static_cast<int>(std::ceil(width / step)));
        for (int part = 1; part < parts; ++part) {
            edges.push_back(angles[i - 1] +
                            width * static_cast<float>(part) / static_cast<float>(parts));
        }
        edges.push_back(angles[i]);
    }
    return edges;
}

/// Position among ascending values.
struct Place {
    std::size_t index = 0;  ///< index of the value before; never the last
    float fraction = 0.0f;  ///< fraction of the interval to the next value, in [0, 1]
};

/// Returns the position of `x` among two or more `values`, clamped to their range.
Place place_in(std::span<const float> values, float x)
{
    const auto after = std::upper_bound(values.begin() + 1, values.end() - 1, x);
    const auto index = static_cast<std::size_t>(after - values.begin()) - 1;
    const float width = values[index + 1] - values[index];
    return {index, std::clamp((x - values[index]) / width, 0.0f, 1.0f)};
}

/// Interpolates bilinearly in the angles; a rotationally symmetric profile has one azimuth.
float interpolate(const LightProfile& grid, float polar_angle, float azimuth)
{
    const std::size_t rows = grid.polar_angles.size();
    const Place row = place_in(grid.polar_angles, polar_angle);
    const auto along = [&](std::size_t column) {
        const float* first = &grid.intensities[column * rows + row.index];
        return (1.0f - row.fraction) * first[0] + row.fraction * first[1];
    };
    if (grid.azimuths.size() == 1) {
        return along(0);
    }
    const Place column = place_in(grid.azimuths, azimuth);
    return (1.0f - column.fraction) * along(column.index) +
           column.fraction * along(column.index + 1);
}

/// Returns the flux between two polar angles per radian of azimuth, for intensities that are linear
/// in between: Simpson's rule with enough parts for an error below 1e-5.
double flux_along(const LightProfile& grid, float from, float to, float azimuth)
{
    constexpr float widest_part = 0.4f;
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / widest_part)));
    const auto at = [&](int half) {
        const float angle =
            from + (to - from) * (static_cast<float>(half) / static_cast<float>(2 * parts));
        return static_cast<double>(interpolate(grid, angle, azimuth)) *
               static_cast<double>(sin_cos(angle).sin);
    };
    double sum = 0.0;
    for (int part = 0; part < parts; ++part) {
        sum += at(2 * part) + 4.0 * at(2 * part + 1) + at(2 * part + 2);
    }
    return sum * static_cast<double>(to - from) / (6.0 * parts);
}

}  // namespace

IntensityProfile::Cells IntensityProfile::cut(const LightProfile& profile)
{
    Cells cells;
    std::vector<float> rows;
    const std::size_t max_cells = std::max(usual_cells, 2 * profile.intensities.size());
    for (float wider = 1.0f; wider < 256.0f; wider *= 2.0f) {
        rows = refine(profile.polar_angles, wider * max_cell_height);
        cells.azimuths = profile.azimuths.size() == 1
                             ? std::vector<float>{0.0f, turn}
                             : refine(profile.azimuths, wider * widest_cell);
        if (rows.size() * cells.azimuths.size() <= max_cells) {
            break;
        }
    }
    std::vector<float> polar;
    for (const float angle : rows) {
        const float height = to_height(angle);
        // Angles too close for their heights to differ share a cell.
        if (cells.heights.empty() || height > cells.heights.back()) {
            cells.heights.push_back(height);
            polar.push_back(angle);
        }
    }
    if (cells.heights.size() < 2) {
        return {.heights = {0.0f, 2.0f}, .azimuths = {0.0f, turn}, .weights = {0.0f}};
    }
    std::vector<double> fluxes;
    std::vector<double> solid_angles;
    double lit = 0.0;
    for (std::size_t row = 0; row + 1 < polar.size(); ++row) {
        const auto height = static_cast<double>(cells.heights[row + 1] - cells.heights[row]);
        double left = flux_along(profile, polar[row], polar[row + 1], cells.azimuths.front());
        for (std::size_t column = 0; column + 1 < cells.azimuths.size(); ++column) {
            const double right =
                flux_along(profile, polar[row], polar[row + 1], cells.azimuths[column + 1]);
            const auto width =
                static_cast<double>(cells.azimuths[column + 1] - cells.azimuths[column]);
            fluxes.push_back(0.5 * width * (left + right));  // linear along the azimuth
            solid_angles.push_back(fluxes.back() > 0.0 ? width * height : 0.0);
            cells.flux += fluxes.back();
            lit += solid_angles.back();
            left = right;
        }
    }
    cells.weights.assign(fluxes.size(), 0.0f);
    for (std::size_t i = 0; i < fluxes.size() && cells.flux > 0.0; ++i) {
        cells.weights[i] =
            static_cast<float>(fluxes[i] / cells.flux + even_share * solid_angles[i] / lit);
    }
    return cells;
}

IntensityProfile::IntensityProfile(const LightProfile& profile)
    : IntensityProfile(profile, cut(profile))
{}

IntensityProfile::IntensityProfile(const LightProfile& profile, const Cells& cells)
    : grid_(profile),
      heights_(cells.heights),
      columns_(cells.azimuths),
      cells_(cells.weights, static_cast<int>(cells.azimuths.size()) - 1,
             static_cast<int>(cells.heights.size()) - 1),
      flux_(static_cast<float>(cells.flux)),
      peak_(*std::max_element(profile.intensities.begin(), profile.intensities.end()))
{}

std::optional<IntensityProfile::Angles> IntensityProfile::find_angles(Vec3 direction) const
{
    const float across = direction.x * direction.x + direction.y * direction.y;
    const float height =
        direction.z < 0.0f ? across / (1.0f - direction.z) : std::min(1.0f + direction.z, 2.0f);
    if (height < heights_.front() || height > heights_.back()) {
        return std::nullopt;
    }
    const float first = columns_.front();
    const float last = columns_.back();
    float azimuth = atan2_exact(direction.y, direction.x);
    azimuth -= turn * std::floor((azimuth - first) / turn);
    if (azimuth <= last || last - first >= turn - rounding) {
        return Angles{height, std::clamp(azimuth, first, last)};
    }
    return azimuth >= first + turn - rounding ? std::optional(Angles{height, first}) : std::nullopt;
}

float IntensityProfile::lookup(const Angles& angles) const
{
    return interpolate(grid_, to_polar_angle(angles.height), angles.azimuth);
}

float IntensityProfile::intensity(Vec3 direction) const
{
    const auto angles = find_angles(direction);
    return angles ? lookup(*angles) : 0.0f;
}

/// Converts a density on the unit square, where all cells are equal, to directions: uniform in each
/// cell.
SolidAnglePdf IntensityProfile::to_solid_angle(float pdf_square, std::size_t column,
                                               std::size_t row) const
{
    const auto columns = static_cast<float>(columns_.size() - 1);
    const auto rows = static_cast<float>(heights_.size() - 1);
    const float width = (columns_[column + 1] - columns_[column]) * columns;
    const float height = (heights_[row + 1] - heights_[row]) * rows;
    return {pdf_square / (width * height)};
}

std::optional<IntensityProfile::Sample> IntensityProfile::sample(Vec2 u) const
{
    if (!(flux_ > 0.0f)) {
        return std::nullopt;
    }
    const auto [point, pdf] = cells_.sample(u);
    if (!(pdf > 0.0f)) {
        return std::nullopt;
    }
    const auto pick = [](const std::vector<float>& edges, float x) {
        const float scaled = x * static_cast<float>(edges.size() - 1);
        const std::size_t cell = std::min(static_cast<std::size_t>(scaled), edges.size() - 2);
        const float offset = scaled - static_cast<float>(cell);
        return std::pair(cell, edges[cell] + offset * (edges[cell + 1] - edges[cell]));
    };
    const auto [column, azimuth] = pick(columns_, point.x);
    const auto [row, height] = pick(heights_, point.y);
    const float sine = std::sqrt(std::max(0.0f, height * (2.0f - height)));
    const SinCos phi = sin_cos(azimuth);
    return Sample{.direction = {sine * phi.cos, sine * phi.sin, height - 1.0f},
                  .intensity = lookup({height, azimuth}),
                  .pdf = to_solid_angle(pdf, column, row)};
}

SolidAnglePdf IntensityProfile::pdf(Vec3 direction) const
{
    const auto angles = find_angles(direction);
    if (!angles || !(flux_ > 0.0f)) {
        return {0.0f};
    }
    const Place column = place_in(columns_, angles->azimuth);
    const Place row = place_in(heights_, angles->height);
    const auto middle = [](std::size_t cell, std::size_t edges) {
        return (static_cast<float>(cell) + 0.5f) / static_cast<float>(edges - 1);
    };
    const Vec2 point(middle(column.index, columns_.size()), middle(row.index, heights_.size()));
    return to_solid_angle(cells_.pdf(point), column.index, row.index);
}

}  // namespace bdpt
