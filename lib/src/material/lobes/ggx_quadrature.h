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

/// The microfacets visible from a direction with this cosine, by points of the spherical cap that
/// the stretched distribution becomes.
class VisibleNormals {
public:
    VisibleNormals(float cosine, float alpha)
        : wo_{std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine},
          stretched_(normalize(Vec3{alpha * wo_.x, 0.0f, wo_.z})),
          stretch_o_(stretch(wo_, alpha)),
          alpha_(alpha)
    {}

    /// Returns the point at this height in (0, 1), at which points are denser in the far tails of
    /// the distribution; `weight` is the fraction of all points.
    [[nodiscard]] QuadraturePoint at(float height, const SinCos& azimuth, float weight) const
    {
        const float left = 1.0f - height;
        const float depth = (1.0f - left * left * left) * (1.0f + stretched_.z);
        const float radius = std::sqrt(std::max(0.0f, depth * (2.0f - depth)));
        const Vec3 cap{radius * azimuth.cos, radius * azimuth.sin, 1.0f - depth};
        const Vec3 slope = cap + stretched_;
        const Vec3 h =
            normalize(Vec3{alpha_ * slope.x, alpha_ * slope.y, std::max(slope.z, 1e-12f)});
        return {{wo_, h, dot(wo_, h)}, 3.0f * left * left * weight, stretch_o_};
    }

private:
    Vec3 wo_;
    Vec3 stretched_;
    float stretch_o_;
    float alpha_;
};

/// Calls `visit` with midpoints of heights and azimuths, over one half of the symmetric range.
/// `cosine` is that of the viewing direction; at most `max_azimuths` azimuths.
template <typename Visit>
void for_each_visible_normal(float cosine, float alpha, int heights, int azimuths,
                             const Visit& visit)
{
    constexpr std::size_t max_azimuths = 16;
    std::array<SinCos, max_azimuths> course;
    for (int j = 0; j < azimuths; ++j) {
        course[static_cast<std::size_t>(j)] =
            sin_cos(pi * (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuths));
    }
    const VisibleNormals normals(cosine, alpha);
    const float weight = 1.0f / static_cast<float>(heights * azimuths);
    for (int i = 0; i < heights; ++i) {
        const float height = (static_cast<float>(i) + 0.5f) / static_cast<float>(heights);
        for (int j = 0; j < azimuths; ++j) {
            visit(normals.at(height, course[static_cast<std::size_t>(j)], weight));
        }
    }
}

}  // namespace bdpt::ggx
