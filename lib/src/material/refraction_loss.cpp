#include "material/refraction_loss.h"

#include "material/lobes/boundary.h"
#include "material/lobes/ggx_quadrature.h"
#include "material/specular_albedo.h"
#include "material/table_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
RefractionLoss::RefractionLoss(const SpecularAlbedo& boundary)
{
    for (const Side side : {Side::outer, Side::inner}) {
        Table& table = side == Side::outer ? outer_ : inner_;
        for (int row = 0; row < roughness_nodes; ++row) {
            const float roughness = static_cast<float>(row) / (roughness_nodes - 1);
            Loss* nodes = table.directional.data() + row * cosine_nodes;
            for (int column = 0; column < cosine_nodes; ++column) {
                const float x = static_cast<float>(column) / (cosine_nodes - 1);
                nodes[column] = integrate(boundary, side, x * x, roughness);
            }
            table.average[static_cast<std::size_t>(row)] = compute_average(nodes);
        }
    }
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
    const Loss* lower = table(side).directional.data() + r.node * cosine_nodes + p.node;
    const Loss* upper = lower + cosine_nodes;
    return value(
        mix(mix(lower[0], lower[1], p.fraction), mix(upper[0], upper[1], p.fraction), r.fraction),
        f0, f90);
}

float RefractionLoss::average(Side side, float roughness, float f0, float f90) const noexcept
{
    const NodePosition r = node_position(roughness * (roughness_nodes - 1), roughness_nodes);
    const auto& averages = table(side).average;
    return value(mix(averages[r.node], averages[r.node + 1], r.fraction), f0, f90);
}

RefractionLoss::Loss RefractionLoss::integrate(const SpecularAlbedo& boundary, Side side,
                                               float cosine, float roughness)
{
    const float alpha = roughness * roughness;
    if (alpha == 0.0f) {
        return {};
    }
    // The quadrature of `SpecularAlbedo`, with more points from within, where total reflection
    // causes an edge: errors of 0.001.
    const int points = side == Side::outer ? 24 : 48;
    const float ior = boundary.ior();
    const float eta = side == Side::outer ? 1.0f / ior : ior;
    Loss loss{.none = 1.0f};
    ggx::for_each_visible_normal(
        cosine, alpha, points, points, [&](const ggx::QuadraturePoint& point) {
            const float cos_h = std::min(1.0f, point.facet.cosine);
            const float leaves_up = point.leaves(
                ggx::Microfacet{point.facet.o, point.facet.h, cos_h}.reflected(), alpha);
            const float cos2_far = (1.0f - eta) * (1.0f + eta) + eta * cos_h * eta * cos_h;
            if (cos2_far <= 0.0f) {
                loss.none -= point.share * leaves_up;  // total reflection
                return;
            }
            const Vec3 down = refracted(point.facet.o, point.facet.h, cos_h, eta);
            const float leaves_down =
                down.z < 0.0f ? -2.0f * down.z / (-down.z + ggx::stretch(down, alpha)) : 0.0f;
            const float g =
                boundary.fresnel_course(side == Side::outer ? cos_h : std::sqrt(cos2_far));
            loss.none -= point.share * leaves_down;
            loss.per_f0 -= point.share * (1.0f - g) * (leaves_up - leaves_down);
            loss.per_f90 -= point.share * g * (leaves_up - leaves_down);
        });
    return loss;
}

}  // namespace bdpt
