#include "material/specular_albedo.h"

#include "material/ggx.h"

#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

using Split = SpecularAlbedo::Split;

/// Where a value in [0, 1] lies among evenly spaced nodes.
struct Position {
    std::size_t node;
    float fraction;
};

[[nodiscard]] Position position(float value, int nodes)
{
    const float scaled = std::clamp(value, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
    const int node = std::min(static_cast<int>(scaled), nodes - 2);
    return {static_cast<std::size_t>(node), scaled - static_cast<float>(node)};
}

[[nodiscard]] Split mix(Split a, Split b, float t)
{
    return {a.f0 + t * (b.f0 - a.f0), a.f90 + t * (b.f90 - a.f90)};
}

}  // namespace

SpecularAlbedo::SpecularAlbedo(float ior)
    : ior_(ior),
      r0_((ior - 1.0f) / (ior + 1.0f) * ((ior - 1.0f) / (ior + 1.0f))),
      inv_range_(0.25f * (ior + 1.0f) * ((ior + 1.0f) / ior))
{
    for (std::size_t row = 0; row < table_.size(); ++row) {
        const float roughness = static_cast<float>(row) / (roughness_nodes - 1);
        for (std::size_t column = 0; column < table_[row].size(); ++column) {
            const float x = static_cast<float>(column) / (cosine_nodes - 1);
            table_[row][column] = integrate(x * x, roughness);
        }
        // 2 c dc = 4 x^3 dx, and E is linear in x between nodes: integrated exactly, so that the
        // average fits the directional values as they are looked up.
        double sum_f0 = 0.0;
        double sum_f90 = 0.0;
        constexpr double step = 1.0 / (cosine_nodes - 1);
        for (std::size_t column = 0; column + 1 < table_[row].size(); ++column) {
            const double a = static_cast<double>(column) * step;
            const double b = a + step;
            const double whole = b * b * b * b - a * a * a * a;
            const double upper = (0.8 * (b * b * b * b * b - a * a * a * a * a) - a * whole) / step;
            const Split& left = table_[row][column];
            const Split& right = table_[row][column + 1];
            sum_f0 += static_cast<double>(left.f0) * (whole - upper) +
                      static_cast<double>(right.f0) * upper;
            sum_f90 += static_cast<double>(left.f90) * (whole - upper) +
                       static_cast<double>(right.f90) * upper;
        }
        average_[row] = {static_cast<float>(sum_f0), static_cast<float>(sum_f90)};
    }
}

Split SpecularAlbedo::integrate(float cosine, float roughness) const
{
    const float alpha = roughness * roughness;
    if (alpha == 0.0f) {
        const float g = fresnel_course(cosine);
        return {1.0f - g, g};
    }
    // Midpoints of the visible normals' own parametrisation: the spherical cap by its height, and
    // the azimuth over one half of its symmetric course.
    constexpr int heights = 16;
    constexpr int azimuths = 8;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const Vec3 wo{sine, 0.0f, cosine};
    const Vec3 stretched = normalize(Vec3{alpha * wo.x, 0.0f, wo.z});
    const float stretch_o = ggx::stretch(wo, alpha);
    Split sum{};
    for (int i = 0; i < heights; ++i) {
        const float depth = (static_cast<float>(i) + 0.5f) / heights * (1.0f + stretched.z);
        const float radius = std::sqrt(depth * (2.0f - depth));
        for (int j = 0; j < azimuths; ++j) {
            const SinCos azimuth = sin_cos(pi * (static_cast<float>(j) + 0.5f) / azimuths);
            const Vec3 cap{radius * azimuth.cos, radius * azimuth.sin, 1.0f - depth};
            const Vec3 slope = cap + stretched;
            const Vec3 h = normalize(Vec3{alpha * slope.x, alpha * slope.y, slope.z});
            const float cos_h = dot(wo, h);
            const Vec3 wi = 2.0f * cos_h * h - wo;
            if (wi.z <= 0.0f) {
                continue;
            }
            // G2 / G1(wo)
            const float masked =
                wi.z * (wo.z + stretch_o) / (wi.z * stretch_o + wo.z * ggx::stretch(wi, alpha));
            const float g = fresnel_course(cos_h);
            sum.f0 += masked * (1.0f - g);
            sum.f90 += masked * g;
        }
    }
    constexpr float share = 1.0f / (heights * azimuths);
    return {sum.f0 * share, sum.f90 * share};
}

Split SpecularAlbedo::directional(float cosine, float roughness) const noexcept
{
    const Position row = position(roughness, roughness_nodes);
    const Position column = position(std::sqrt(std::max(0.0f, cosine)), cosine_nodes);
    const Row& lower = table_[row.node];
    const Row& upper = table_[row.node + 1];
    return mix(mix(lower[column.node], lower[column.node + 1], column.fraction),
               mix(upper[column.node], upper[column.node + 1], column.fraction), row.fraction);
}

Split SpecularAlbedo::average(float roughness) const noexcept
{
    const Position row = position(roughness, roughness_nodes);
    return mix(average_[row.node], average_[row.node + 1], row.fraction);
}

}  // namespace bdpt
