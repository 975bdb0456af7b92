#include "material/refraction_loss.h"

#include "material/lobes/boundary.h"
#include "material/lobes/ggx_quadrature.h"
#include "material/specular_albedo.h"
#include "material/table_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace bdpt {
namespace {

// Numbers of points of the quadrature; more from within, where total reflection begins at an edge.
// Errors are at most 0.001 from outside, and 0.006 from within, where their mean is 0.001.
constexpr int outer_points = 256;
constexpr int inner_points = 1024;

/// Returns the sines and cosines of azimuths that turn by the golden section: a lattice. An edge is
/// a curve of any shape, and products of one-dimensional rules need twice as many points for it.
[[nodiscard]] std::array<SinCos, inner_points> golden_azimuths()
{
    constexpr double golden_section = 0.6180339887498949;
    std::array<SinCos, inner_points> azimuths{};
    for (int i = 0; i < inner_points; ++i) {
        const double turns = (i + 0.5) * golden_section;
        azimuths[static_cast<std::size_t>(i)] =
            sin_cos(2.0f * pi * static_cast<float>(turns - static_cast<int>(turns)));
    }
    return azimuths;
}

/// Returns `ggx::stretch` of a unit vector with this z.
[[nodiscard]] float stretch_at(float z, float alpha)
{
    return std::sqrt(z * z + alpha * alpha * std::max(0.0f, 1.0f - z * z));
}

}  // namespace

const RefractionLoss::Table& RefractionLoss::table(Side side, std::size_t node) const
{
    const Table& table = side == Side::outer ? outer_ : inner_;
    table.rows.require(node, [this, side](std::size_t row) { make_row(side, row); });
    return table;
}

void RefractionLoss::make_row(Side side, std::size_t row) const
{
    Table& table = side == Side::outer ? outer_ : inner_;
    const float roughness = static_cast<float>(row) / (roughness_nodes - 1);
    const float alpha = roughness * roughness;
    Loss* nodes = table.directional.data() + row * cosine_nodes;
    const std::array azimuths = golden_azimuths();
    const std::span points(azimuths.data(), static_cast<std::size_t>(
                                                side == Side::outer ? outer_points : inner_points));
    for (int column = 0; alpha > 0.0f && column < cosine_nodes; ++column) {
        const float x = static_cast<float>(column) / (cosine_nodes - 1);
        nodes[column] = integrate(side, x * x, alpha, points);
    }
    table.average[row] = compute_average(nodes);
}

RefractionLoss::Loss RefractionLoss::mix(const Loss& a, const Loss& b, float t)
{
    return {a.none + t * (b.none - a.none), a.per_f0 + t * (b.per_f0 - a.per_f0),
            a.per_f90 + t * (b.per_f90 - a.per_f90)};
}

float RefractionLoss::value(const Loss& loss, float f0, float f90)
{
    return std::clamp(loss.none + f0 * loss.per_f0 + f90 * loss.per_f90, 0.0f, 1.0f);
}

RefractionLoss::Loss RefractionLoss::compute_average(const Loss* row)
{
    Loss sum;
    for_each_cosine_interval(cosine_nodes, [&](int column, float share, float fraction) {
        const Loss mean = mix(row[column], row[column + 1], fraction);
        sum = {sum.none + share * mean.none, sum.per_f0 + share * mean.per_f0,
               sum.per_f90 + share * mean.per_f90};
    });
    return sum;
}

float RefractionLoss::directional(Side side, float cosine, float roughness, float f0,
                                  float f90) const noexcept
{
    const NodePosition p = node_position(std::sqrt(cosine) * (cosine_nodes - 1), cosine_nodes);
    const NodePosition r = node_position(roughness * (roughness_nodes - 1), roughness_nodes);
    const Loss* lower = table(side, r.node).directional.data() + r.node * cosine_nodes + p.node;
    const Loss* upper = lower + cosine_nodes;
    return value(
        mix(mix(lower[0], lower[1], p.fraction), mix(upper[0], upper[1], p.fraction), r.fraction),
        f0, f90);
}

float RefractionLoss::average(Side side, float roughness, float f0, float f90) const noexcept
{
    const NodePosition r = node_position(roughness * (roughness_nodes - 1), roughness_nodes);
    const auto& averages = table(side, r.node).average;
    return value(mix(averages[r.node], averages[r.node + 1], r.fraction), f0, f90);
}

RefractionLoss::Loss RefractionLoss::integrate(Side side, float cosine, float alpha,
                                               std::span<const SinCos> azimuths) const
{
    const ggx::VisibleNormals normals(cosine, alpha);
    const float ior = boundary_.ior();
    const float eta = side == Side::outer ? 1.0f / ior : ior;
    const std::size_t points = azimuths.size();
    const float weight = 1.0f / static_cast<float>(points);
    // Compilers vectorise this loop, but not the sum, whose order matters.
    std::array<Loss, inner_points> parts;
    for (std::size_t i = 0; i < points; ++i) {
        const float height = (static_cast<float>(static_cast<int>(i)) + 0.5f) * weight;
        const ggx::QuadraturePoint point = normals.at(height, azimuths[i], weight);
        const float cos_h = std::min(1.0f, point.facet.cosine);
        const float cos_far =
            std::sqrt(std::max(0.0f, (1.0f - eta) * (1.0f + eta) + eta * cos_h * eta * cos_h));
        const float up = 2.0f * cos_h * point.facet.h.z - cosine;
        const float down = (eta * cos_h - cos_far) * point.facet.h.z - eta * cosine;
        const float leaves_up =
            std::max(0.0f, up) * (cosine + point.stretch_o) /
            std::max(std::max(0.0f, up) * point.stretch_o + cosine * stretch_at(up, alpha), 1e-30f);
        const float leaves_down =
            std::max(0.0f, -down) * 2.0f / (std::max(0.0f, -down) + stretch_at(down, alpha));
        const float g = boundary_.fresnel_course(side == Side::outer ? cos_h : cos_far);
        const bool is_total = cos_far == 0.0f;
        const float difference = is_total ? 0.0f : point.share * (leaves_up - leaves_down);
        parts[i] = {.none = point.share * (is_total ? leaves_up : leaves_down),
                    .per_f0 = (1.0f - g) * difference,
                    .per_f90 = g * difference};
    }
    Loss loss{.none = 1.0f};
    for (std::size_t i = 0; i < points; ++i) {
        loss.none -= parts[i].none;
        loss.per_f0 -= parts[i].per_f0;
        loss.per_f90 -= parts[i].per_f90;
    }
    return loss;
}

}  // namespace bdpt
