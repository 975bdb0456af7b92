#include "material/specular_albedo.h"

#include "material/lobes/ggx.h"

#include <cmath>
#include <cstddef>

namespace bdpt {

using Split = SpecularAlbedo::Split;

SpecularAlbedo::SpecularAlbedo(float ior, Below below)
    : ior_(std::clamp(ior, 1.0f, 1e6f)),
      r0_((ior_ - 1.0f) / (ior_ + 1.0f) * ((ior_ - 1.0f) / (ior_ + 1.0f))),
      inv_range_(0.25f * (ior_ + 1.0f) * ((ior_ + 1.0f) / ior_))
{
    for (int row = 0; row < roughness_nodes; ++row) {
        const float roughness = static_cast<float>(row) / (roughness_nodes - 1);
        for (int column = 0; column < cosine_nodes; ++column) {
            const float x = static_cast<float>(column) / (cosine_nodes - 1);
            table_[static_cast<std::size_t>(row * cosine_nodes + column)] =
                integrate(x * x, roughness);
        }
        average_[static_cast<std::size_t>(row)] = average_of_row(row);
    }
    if (below == Below::transparent_body) {
        loss_ = std::make_unique<const RefractionLoss>(*this);
    }
}

/// 2 c dc = 4 x^3 dx, and the albedo is linear in x between nodes: integrated exactly, so that the
/// average fits the directional values as they are looked up.
Split SpecularAlbedo::average_of_row(int row) const
{
    constexpr double step = 1.0 / (cosine_nodes - 1);
    const Split* nodes = table_.data() + row * cosine_nodes;
    double f0 = 0.0;
    double f90 = 0.0;
    for (int column = 0; column + 1 < cosine_nodes; ++column) {
        const double a = column * step;
        const double b = a + step;
        const double whole = b * b * b * b - a * a * a * a;
        const double right = (0.8 * (b * b * b * b * b - a * a * a * a * a) - a * whole) / step;
        const double left = whole - right;
        f0 += static_cast<double>(nodes[column].f0) * left +
              static_cast<double>(nodes[column + 1].f0) * right;
        f90 += static_cast<double>(nodes[column].f90) * left +
               static_cast<double>(nodes[column + 1].f90) * right;
    }
    return {static_cast<float>(f0), static_cast<float>(f90)};
}

Split SpecularAlbedo::integrate(float cosine, float roughness) const
{
    const float alpha = roughness * roughness;
    if (alpha == 0.0f) {
        const float g = fresnel_course(cosine);
        return {1.0f - g, g};
    }
    // Midpoints of the visible normals' own parametrisation: the azimuth over one half of its
    // symmetric course, and the height on the spherical cap, drawn together where the far tails of
    // the distribution are.
    constexpr int heights = 16;
    constexpr int azimuths = 8;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const Vec3 wo{sine, 0.0f, cosine};
    const Vec3 stretched = normalize(Vec3{alpha * wo.x, 0.0f, wo.z});
    const float stretch_o = ggx::stretch(wo, alpha);
    Split sum{};
    for (int i = 0; i < heights; ++i) {
        const float left = 1.0f - (static_cast<float>(i) + 0.5f) / heights;
        const float share = 3.0f * left * left / (heights * azimuths);
        const float depth = (1.0f - left * left * left) * (1.0f + stretched.z);
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
            const float masked = share * wi.z * (wo.z + stretch_o) /
                                 (wi.z * stretch_o + wo.z * ggx::stretch(wi, alpha));
            const float g = fresnel_course(cos_h);
            sum.f0 += masked * (1.0f - g);
            sum.f90 += masked * g;
        }
    }
    return sum;
}

}  // namespace bdpt
