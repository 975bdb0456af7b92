#include "material/coat_loss.h"

#include "material/lobes/ggx_quadrature.h"
#include "material/table_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bdpt {
namespace {

using Directional = CoatLoss::Directional;
using Average = CoatLoss::Average;

[[nodiscard]] Directional mix_losses(const Directional& a, const Directional& b, float t)
{
    return {a.f0 + t * (b.f0 - a.f0), a.f90 + t * (b.f90 - a.f90),
            a.below + t * (b.below - a.below), a.below_f0 + t * (b.below_f0 - a.below_f0),
            a.below_f90 + t * (b.below_f90 - a.below_f90)};
}

[[nodiscard]] Average mix_losses(const Average& a, const Average& b, float t)
{
    return {a.f0 + t * (b.f0 - a.f0),
            a.f90 + t * (b.f90 - a.f90),
            a.below + t * (b.below - a.below),
            a.below_f0 + t * (b.below_f0 - a.below_f0),
            a.below_f90 + t * (b.below_f90 - a.below_f90),
            a.below_f0_f0 + t * (b.below_f0_f0 - a.below_f0_f0),
            a.below_f0_f90 + t * (b.below_f0_f90 - a.below_f0_f90),
            a.below_f90_f90 + t * (b.below_f90_f90 - a.below_f90_f90)};
}

[[nodiscard]] float coat_albedo(const SpecularAlbedo& coat, float cosine,
                                SpecularAlbedo::Roughness roughness)
{
    const SpecularAlbedo::Split split = coat.directional(cosine, roughness);
    return std::min(1.0f, coat.normal_reflectance() * split.f0 + split.f90);
}

[[nodiscard]] SpecularAlbedo::Roughness roughness_at(int node, int nodes)
{
    return SpecularAlbedo::at_roughness(static_cast<float>(node) / static_cast<float>(nodes - 1));
}

/// Returns the cosine at a node, evenly spaced in sqrt(cosine).
[[nodiscard]] float cosine_at(int node, int nodes)
{
    const float x = static_cast<float>(node) / static_cast<float>(nodes - 1);
    return x * x;
}

/// Returns the coat's albedo at the nodes of cosines.
template <std::size_t Nodes>
[[nodiscard]] std::array<float, Nodes> coat_row(const SpecularAlbedo& coat,
                                                SpecularAlbedo::Roughness roughness)
{
    std::array<float, Nodes> row{};
    for (std::size_t i = 0; i < Nodes; ++i) {
        row[i] = coat_albedo(coat, cosine_at(static_cast<int>(i), Nodes), roughness);
    }
    return row;
}

}  // namespace

CoatLoss::CoatLoss(const SpecularAlbedo& coat) : fresnel_rise_(coat.average({}).f90)
{
    integrate_boundary(coat);
    integrate_below(coat);
    integrate_averages(coat);
}

void CoatLoss::integrate_boundary(const SpecularAlbedo& coat)
{
    for (int base = 1; base < roughness_nodes; ++base) {  // a mirror loses nothing
        const float roughness = roughness_at(base, roughness_nodes).value();
        const float alpha = roughness * roughness;
        for (int column = 0; column < cosine_nodes; ++column) {
            const float cosine = cosine_at(column, cosine_nodes);
            std::array<float, roughness_nodes> reflected{};
            for (int c = 0; c < roughness_nodes; ++c) {
                reflected[static_cast<std::size_t>(c)] =
                    coat_albedo(coat, cosine, roughness_at(c, roughness_nodes));
            }
            const auto add = [&](const ggx::QuadraturePoint& point) {
                const Vec3 wi = point.facet.reflected();
                const float leaves = point.share * point.leaves(wi, alpha);
                const float g = coat.fresnel_course(point.facet.cosine);
                for (std::size_t c = 0; leaves > 0.0f && c < roughness_nodes; ++c) {
                    const float there =
                        coat_albedo(coat, std::min(1.0f, wi.z),
                                    roughness_at(static_cast<int>(c), roughness_nodes));
                    const float lost = leaves * std::max(0.0f, there - reflected[c]);
                    Directional& node =
                        directional_[row(static_cast<std::size_t>(base), c) * cosine_nodes +
                                     static_cast<std::size_t>(column)];
                    node.f0 += lost * (1.0f - g);
                    node.f90 += lost * g;
                }
            };
            ggx::for_each_visible_normal(cosine, alpha, 16, 8, add);
        }
    }
}

void CoatLoss::integrate_below(const SpecularAlbedo& coat)
{
    // Midpoints evenly spaced in sqrt(cosine).
    constexpr int points = 128;
    for (int c = 0; c < roughness_nodes; ++c) {
        const SpecularAlbedo::Roughness of_coat = roughness_at(c, roughness_nodes);
        const std::array<float, cosine_nodes> reflected = coat_row<cosine_nodes>(coat, of_coat);
        for (int base = 0; base < roughness_nodes; ++base) {
            const SpecularAlbedo::Roughness of_base = roughness_at(base, roughness_nodes);
            Directional* nodes =
                directional_.data() +
                row(static_cast<std::size_t>(base), static_cast<std::size_t>(c)) * cosine_nodes;
            for (int i = 0; i < points; ++i) {
                const float x = (static_cast<float>(i) + 0.5f) / points;
                const float cosine = x * x;
                const float there = coat_albedo(coat, cosine, of_coat);
                const SpecularAlbedo::Split kept = coat.directional(cosine, of_base);
                for (int column = 0; column < cosine_nodes; ++column) {
                    const float here = reflected[static_cast<std::size_t>(column)];
                    const float lost = 4.0f * x * cosine / points * std::max(0.0f, there - here);
                    nodes[column].below += lost;
                    nodes[column].below_f0 += lost * kept.f0;
                    nodes[column].below_f90 += lost * kept.f90;
                }
            }
        }
    }
}

void CoatLoss::integrate_averages(const SpecularAlbedo& coat)
{
    for (int base = 0; base < roughness_nodes; ++base) {
        const SpecularAlbedo::Roughness of_base = roughness_at(base, roughness_nodes);
        for (int c = 0; c < roughness_nodes; ++c) {
            const std::size_t at = row(static_cast<std::size_t>(base), static_cast<std::size_t>(c));
            const Directional* nodes = directional_.data() + at * cosine_nodes;
            Average& sum = average_[at];
            for_each_cosine_interval(cosine_nodes, [&](int column, float share, float fraction) {
                const float x = (static_cast<float>(column) + fraction) / (cosine_nodes - 1);
                const SpecularAlbedo::Split kept = coat.directional(x * x, of_base);
                const Directional lost = mix_losses(nodes[column], nodes[column + 1], fraction);
                sum.f0 += share * lost.f0;
                sum.f90 += share * lost.f90;
                sum.below += share * lost.below;
                sum.below_f0 += share * (lost.below_f0 + kept.f0 * lost.below);
                sum.below_f90 += share * (lost.below_f90 + kept.f90 * lost.below);
                sum.below_f0_f0 += share * kept.f0 * lost.below_f0;
                sum.below_f0_f90 += share * (kept.f0 * lost.below_f90 + kept.f90 * lost.below_f0);
                sum.below_f90_f90 += share * kept.f90 * lost.below_f90;
            });
        }
    }
}

Directional CoatLoss::directional(float cosine, Roughness base, Roughness coat) const noexcept
{
    const NodePosition p = node_position(std::sqrt(cosine) * (cosine_nodes - 1), cosine_nodes);
    const NodePosition b = node_position(base.value() * (roughness_nodes - 1), roughness_nodes);
    const NodePosition c = node_position(coat.value() * (roughness_nodes - 1), roughness_nodes);
    const auto at = [&](std::size_t base_node, std::size_t coat_node) {
        const Directional* nodes =
            directional_.data() + row(base_node, coat_node) * cosine_nodes + p.node;
        return mix_losses(nodes[0], nodes[1], p.fraction);
    };
    return mix_losses(mix_losses(at(b.node, c.node), at(b.node, c.node + 1), c.fraction),
                      mix_losses(at(b.node + 1, c.node), at(b.node + 1, c.node + 1), c.fraction),
                      b.fraction);
}

Average CoatLoss::average(Roughness base, Roughness coat) const noexcept
{
    const NodePosition b = node_position(base.value() * (roughness_nodes - 1), roughness_nodes);
    const NodePosition c = node_position(coat.value() * (roughness_nodes - 1), roughness_nodes);
    const auto at = [&](std::size_t base_node) {
        return mix_losses(average_[row(base_node, c.node)], average_[row(base_node, c.node + 1)],
                          c.fraction);
    };
    return mix_losses(at(b.node), at(b.node + 1), b.fraction);
}

}  // namespace bdpt
