#pragma once

#include "material/lobes/ggx.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt::ggx {

/// A quadrature point: a half vector of the microfacets visible from one direction.
struct QuadraturePoint {
    Microfacet facet;
    float share;      ///< fraction of all visible microfacets
    float stretch_o;  ///< `stretch` of `facet.o`

    /// Returns the fraction of light towards `up`, on the side of the light, that no other
    /// microfacet masks: G2 / G1(o).
    [[nodiscard]] float leaves(Vec3 up, float alpha) const
    {
        const float cos_o = facet.o.z;
        return up.z > 0.0f
                   ? up.z * (cos_o + stretch_o) / (up.z * stretch_o + cos_o * stretch(up, alpha))
                   : 0.0f;
    }
};

inline constexpr std::size_t max_azimuths = 48;

/// Calls `visit` with midpoints of the parametrisation of visible normals: the azimuth over one
/// half of its symmetric range, and the height on the spherical cap, denser in the far tails of the
/// distribution. `cosine` is that of the viewing direction; at most `max_azimuths` azimuths.
template <typename Visit>
void for_each_visible_normal(float cosine, float alpha, int heights, int azimuths,
                             const Visit& visit)
{
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const Vec3 wo{sine, 0.0f, cosine};
    const Vec3 stretched = normalize(Vec3{alpha * wo.x, 0.0f, wo.z});
    const float stretch_o = stretch(wo, alpha);
    std::array<SinCos, max_azimuths> course;
    for (int j = 0; j < azimuths; ++j) {
        course[static_cast<std::size_t>(j)] =
            sin_cos(pi * (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuths));
    }
    for (int i = 0; i < heights; ++i) {
        const float left = 1.0f - (static_cast<float>(i) + 0.5f) / static_cast<float>(heights);
        const float share = 3.0f * left * left / static_cast<float>(heights * azimuths);
        const float depth = (1.0f - left * left * left) * (1.0f + stretched.z);
        const float radius = std::sqrt(depth * (2.0f - depth));
        for (int j = 0; j < azimuths; ++j) {
            const SinCos& azimuth = course[static_cast<std::size_t>(j)];
            const Vec3 cap{radius * azimuth.cos, radius * azimuth.sin, 1.0f - depth};
            const Vec3 slope = cap + stretched;
            const Vec3 h = normalize(Vec3{alpha * slope.x, alpha * slope.y, slope.z});
            visit(QuadraturePoint{{wo, h, dot(wo, h)}, share, stretch_o});
        }
    }
}

}  // namespace bdpt::ggx
