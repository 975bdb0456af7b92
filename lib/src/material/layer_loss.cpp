#include "material/layer_loss.h"

#include "material/lobes/fuzz.h"
#include "material/lobes/ggx_quadrature.h"
#include "material/table_nodes.h"
#include "math/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bdpt {
namespace {

using Directional = LayerLoss::Directional;
using Average = LayerLoss::Average;
using AtFibres = LayerLoss::AtFibres;

[[nodiscard]] Directional mix_losses(const Directional& a, const Directional& b, float t)
{
    return {a.f0 + t * (b.f0 - a.f0), a.f90 + t * (b.f90 - a.f90),
            a.below + t * (b.below - a.below), a.below_f0 + t * (b.below_f0 - a.below_f0),
            a.below_f90 + t * (b.below_f90 - a.below_f90)};
}

[[nodiscard]] AtFibres mix_losses(const AtFibres& a, const AtFibres& b, float t)
{
    return {a.reflected + t * (b.reflected - a.reflected), a.passed + t * (b.passed - a.passed)};
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

[[nodiscard]] SpecularAlbedo::Roughness roughness_at(int node, int nodes)
{
    return SpecularAlbedo::Roughness::of_row(static_cast<std::size_t>(node), nodes);
}

/// Returns the cosine at a node, evenly spaced in sqrt(cosine).
[[nodiscard]] float cosine_at(int node, int nodes)
{
    const float x = static_cast<float>(node) / static_cast<float>(nodes - 1);
    return x * x;
}

}  // namespace

/// Albedos of the layer at all nodes of its roughness.
class LayerLoss::Albedos {
public:
    using Row = std::array<float, roughness_nodes>;

    explicit Albedos(const Albedo& layer)
    {
        for (int column = 0; column < columns; ++column) {
            for (int c = 0; c < roughness_nodes; ++c) {
                rows_[static_cast<std::size_t>(column)][static_cast<std::size_t>(c)] =
                    layer(cosine_at(column, columns), roughness_at(c, roughness_nodes));
            }
        }
    }
    [[nodiscard]] Row at(float cosine) const
    {
        const NodePosition p = node_position(std::sqrt(cosine) * (columns - 1), columns);
        const Row& left = rows_[p.node];
        const Row& right = rows_[p.node + 1];
        Row result;
        for (std::size_t c = 0; c < result.size(); ++c) {
            result[c] = left[c] + p.fraction * (right[c] - left[c]);
        }
        return result;
    }

private:
    static constexpr int columns = 256;  // evenly spaced in sqrt(cosine)
    std::array<Row, columns> rows_;
};

LayerLoss::LayerLoss(const SpecularAlbedo& boundary, const Albedo& layer, const FuzzTable* fibres)
    : fresnel_rise_(boundary.average({}).f90)
{
    const Albedos albedos(layer);
    integrate_boundary(boundary, albedos);
    integrate_below(boundary, albedos);
    integrate_averages(boundary);
    if (fibres != nullptr) {
        integrate_fibres(*fibres, albedos);
    }
}

void LayerLoss::integrate_boundary(const SpecularAlbedo& boundary, const Albedos& layer)
{
    for (int base = 1; base < roughness_nodes; ++base) {  // a mirror loses nothing
        const float roughness = roughness_at(base, roughness_nodes).value();
        const float alpha = roughness * roughness;
        for (int column = 0; column < cosine_nodes; ++column) {
            const float cosine = cosine_at(column, cosine_nodes);
            const Albedos::Row here = layer.at(cosine);
            const auto add = [&](const ggx::QuadraturePoint& point) {
                const Vec3 wi = point.facet.reflected();
                const float leaves = point.share * point.leaves(wi, alpha);
                if (!(leaves > 0.0f)) {
                    return;
                }
                const float g = boundary.fresnel_course(point.facet.cosine);
                const Albedos::Row there = layer.at(std::min(1.0f, wi.z));
                for (std::size_t c = 0; c < roughness_nodes; ++c) {
                    const float lost = leaves * std::max(0.0f, there[c] - here[c]);
                    Directional& node =
                        directional_[row(static_cast<std::size_t>(base), c) * cosine_nodes +
                                     static_cast<std::size_t>(column)];
                    node.f0 += lost * (1.0f - g);
                    node.f90 += lost * g;
                }
            };
            ggx::for_each_visible_normal(cosine, alpha, 40, 16, add);
        }
    }
}

void LayerLoss::integrate_below(const SpecularAlbedo& boundary, const Albedos& layer)
{
    // Midpoints evenly spaced in sqrt(cosine).
    constexpr int points = 128;
    std::array<Albedos::Row, cosine_nodes> here;
    for (int column = 0; column < cosine_nodes; ++column) {
        here[static_cast<std::size_t>(column)] = layer.at(cosine_at(column, cosine_nodes));
    }
    for (int i = 0; i < points; ++i) {
        const float x = (static_cast<float>(i) + 0.5f) / points;
        const float cosine = x * x;
        const float area = 4.0f * x * cosine / points;  // of cos d cos, over 1/2
        const Albedos::Row there = layer.at(cosine);
        for (int base = 0; base < roughness_nodes; ++base) {
            const SpecularAlbedo::Split kept =
                boundary.directional(cosine, roughness_at(base, roughness_nodes));
            for (std::size_t c = 0; c < roughness_nodes; ++c) {
                Directional* nodes =
                    directional_.data() + row(static_cast<std::size_t>(base), c) * cosine_nodes;
                for (std::size_t column = 0; column < cosine_nodes; ++column) {
                    const float lost = area * std::max(0.0f, there[c] - here[column][c]);
                    nodes[column].below += lost;
                    nodes[column].below_f0 += lost * kept.f0;
                    nodes[column].below_f90 += lost * kept.f90;
                }
            }
        }
    }
}

void LayerLoss::integrate_averages(const SpecularAlbedo& boundary)
{
    for (int base = 0; base < roughness_nodes; ++base) {
        const SpecularAlbedo::Roughness of_base = roughness_at(base, roughness_nodes);
        for (int c = 0; c < roughness_nodes; ++c) {
            const std::size_t at = row(static_cast<std::size_t>(base), static_cast<std::size_t>(c));
            const Directional* nodes = directional_.data() + at * cosine_nodes;
            Average& sum = average_[at];
            for_each_cosine_interval(cosine_nodes, [&](int column, float share, float fraction) {
                const float x = (static_cast<float>(column) + fraction) / (cosine_nodes - 1);
                const SpecularAlbedo::Split kept = boundary.directional(x * x, of_base);
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

void LayerLoss::integrate_fibres(const FuzzTable& fibres, const Albedos& layer)
{
    constexpr int heights = 24;  // evenly spaced in sqrt(cosine)
    constexpr int azimuths = 12;
    at_fibres_.resize(directional_.size());
    for (int base = 0; base < roughness_nodes; ++base) {
        const float roughness = FuzzTable::roughness_of(roughness_at(base, roughness_nodes));
        const auto passed = [roughness](float cosine) {
            return 1.0f - FuzzTable::directional(cosine, roughness);
        };
        float passed_average = 0.0f;
        for (int i = 0; i < heights; ++i) {
            const float x = (static_cast<float>(i) + 0.5f) / heights;
            passed_average += 4.0f * x * x * x / heights * passed(x * x);
        }
        for (int column = 0; column < cosine_nodes; ++column) {
            const float cos_o = std::max(cosine_at(column, cosine_nodes), 1e-4f);
            const Vec3 wo{std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o};
            const Albedos::Row here = layer.at(cos_o);
            for (int i = 0; i < heights; ++i) {
                const float x = (static_cast<float>(i) + 0.5f) / heights;
                const float cos_i = x * x;
                const float sine = std::sqrt(1.0f - cos_i * cos_i);
                float around = 0.0f;
                for (int j = 0; j < azimuths; ++j) {
                    const SinCos turn = sin_cos(pi * (static_cast<float>(j) + 0.5f) / azimuths);
                    around +=
                        fibres.value(wo, {sine * turn.cos, sine * turn.sin, cos_i}, roughness);
                }
                const float area = 4.0f * x * cos_i / heights;  // of cos d cos, over 1/2
                const Albedos::Row there = layer.at(cos_i);
                for (std::size_t c = 0; c < roughness_nodes; ++c) {
                    const float lost = area * std::max(0.0f, there[c] - here[c]);
                    AtFibres& node =
                        at_fibres_[row(static_cast<std::size_t>(base), c) * cosine_nodes +
                                   static_cast<std::size_t>(column)];
                    node.reflected += lost * around * pi / azimuths;
                    node.passed += lost * passed(cos_i) / passed_average;
                }
            }
        }
    }
}

template <typename Loss>
Loss LayerLoss::interpolated(const Loss* table, float cosine, Roughness base,
                             Roughness layer) noexcept
{
    const NodePosition p = node_position(std::sqrt(cosine) * (cosine_nodes - 1), cosine_nodes);
    const NodePosition b = base.position(roughness_nodes);
    const NodePosition c = layer.position(roughness_nodes);
    const auto at = [&](std::size_t base_node, std::size_t layer_node) {
        const Loss* nodes = table + row(base_node, layer_node) * cosine_nodes + p.node;
        return mix_losses(nodes[0], nodes[1], p.fraction);
    };
    return mix_losses(mix_losses(at(b.node, c.node), at(b.node, c.node + 1), c.fraction),
                      mix_losses(at(b.node + 1, c.node), at(b.node + 1, c.node + 1), c.fraction),
                      b.fraction);
}

Directional LayerLoss::directional(float cosine, Roughness base, Roughness layer) const noexcept
{
    return interpolated(directional_.data(), cosine, base, layer);
}

AtFibres LayerLoss::at_fibres(float cosine, Roughness fibres, Roughness layer) const noexcept
{
    return interpolated(at_fibres_.data(), cosine, fibres, layer);
}

Average LayerLoss::average(Roughness base, Roughness layer) const noexcept
{
    const NodePosition b = base.position(roughness_nodes);
    const NodePosition c = layer.position(roughness_nodes);
    const auto at = [&](std::size_t base_node) {
        return mix_losses(average_[row(base_node, c.node)], average_[row(base_node, c.node + 1)],
                          c.fraction);
    };
    return mix_losses(at(b.node), at(b.node + 1), b.fraction);
}

}  // namespace bdpt
