#include "material/refraction_loss.h"

#include "material/lobes/boundary.h"
#include "material/lobes/ggx.h"
#include "material/specular_albedo.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

/// Where a value lies among evenly spaced nodes.
struct NodePosition {
    std::size_t node;
    float fraction;
};

NodePosition node_position(float scaled, int nodes)
{
    const int node = std::clamp(static_cast<int>(scaled), 0, nodes - 2);
    return {static_cast<std::size_t>(node), scaled - static_cast<float>(node)};
}

}  // namespace

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
            table.average[static_cast<std::size_t>(row)] = average_of(nodes);
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

/// 2 c dc = 4 x^3 dx, and the loss is linear in x between nodes, as it is looked up.
RefractionLoss::Loss RefractionLoss::average_of(const Loss* row)
{
    constexpr float step = 1.0f / (cosine_nodes - 1);
    Loss sum;
    for (int column = 0; column + 1 < cosine_nodes; ++column) {
        const float a = static_cast<float>(column) * step;
        const float b = a + step;
        const float whole = b * b * b * b - a * a * a * a;
        const float right = (0.8f * (b * b * b * b * b - a * a * a * a * a) - a * whole) / step;
        const Loss mean = mix(row[column], row[column + 1], right / whole);
        sum = {sum.none + whole * mean.none, sum.per_f0 + whole * mean.per_f0,
               sum.per_f90 + whole * mean.per_f90};
    }
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
    // The quadrature of `SpecularAlbedo`, with more points from within, where total reflection has
    // an edge: errors of 0.001.
    const int heights = side == Side::outer ? 24 : 48;
    const int azimuths = heights;
    const float ior = boundary.ior();
    const float eta = side == Side::outer ? 1.0f / ior : ior;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const Vec3 wo{sine, 0.0f, cosine};
    const Vec3 stretched = normalize(Vec3{alpha * wo.x, 0.0f, wo.z});
    const float stretch_o = ggx::stretch(wo, alpha);
    Loss loss{.none = 1.0f};
    for (int i = 0; i < heights; ++i) {
        const float left = 1.0f - (static_cast<float>(i) + 0.5f) / static_cast<float>(heights);
        const float share = 3.0f * left * left / static_cast<float>(heights * azimuths);
        const float depth = (1.0f - left * left * left) * (1.0f + stretched.z);
        const float radius = std::sqrt(depth * (2.0f - depth));
        for (int j = 0; j < azimuths; ++j) {
            const SinCos azimuth =
                sin_cos(pi * (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuths));
            const Vec3 cap{radius * azimuth.cos, radius * azimuth.sin, 1.0f - depth};
            const Vec3 slope = cap + stretched;
            const Vec3 h = normalize(Vec3{alpha * slope.x, alpha * slope.y, slope.z});
            const float cos_h = std::min(1.0f, dot(wo, h));
            const Vec3 up = 2.0f * cos_h * h - wo;
            // G2 / G1(wo)
            const float leaves_up = up.z > 0.0f
                                        ? up.z * (wo.z + stretch_o) /
                                              (up.z * stretch_o + wo.z * ggx::stretch(up, alpha))
                                        : 0.0f;
            const float cos2_far = (1.0f - eta) * (1.0f + eta) + eta * cos_h * eta * cos_h;
            if (cos2_far <= 0.0f) {
                loss.none -= share * leaves_up;  // total reflection
                continue;
            }
            const Vec3 down = refracted(wo, h, cos_h, eta);
            const float leaves_down =
                down.z < 0.0f ? -2.0f * down.z / (-down.z + ggx::stretch(down, alpha)) : 0.0f;
            const float g =
                boundary.fresnel_course(side == Side::outer ? cos_h : std::sqrt(cos2_far));
            loss.none -= share * leaves_down;
            loss.per_f0 -= share * (1.0f - g) * (leaves_up - leaves_down);
            loss.per_f90 -= share * g * (leaves_up - leaves_down);
        }
    }
    return loss;
}

}  // namespace bdpt
