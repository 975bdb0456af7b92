#include "light/triangle_emission.h"

#include "math/rgb.h"
#include "math/warp.h"

#include <algorithm>
#include <cmath>
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

}  // namespace bdpt
