#pragma once

#include "material/table_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt {

/// Albedo of single scattering by white microfacets [Heitz 2014], a table that
/// `make_white_albedo.py` writes: exact within 0.0015, and too small by 0.0005 at most, so that
/// lobes that restore the rest make no light.
class WhiteAlbedo {
public:
    /// Returns the albedo for light from a direction with this cosine in [0, 1]. `roughness` is
    /// perceptual, in [0, 1]; rough, as the albedo of smooth surfaces is 1.
    [[nodiscard]] static float directional(float cosine, float roughness) noexcept
    {
        // Masking matters where the cosine is not much larger than alpha. In this coordinate that
        // region has half of the nodes, however smooth the surface.
        const float root = std::sqrt(cosine);
        const float place = root * (1.0f + roughness) / std::max(root + roughness, 1e-6f);
        const NodePosition p = node_position(place * (cosine_nodes - 1), cosine_nodes);
        const NodePosition r = node_position(roughness * (roughness_nodes - 1), roughness_nodes);
        const float* lower = nodes.data() + r.node * cosine_nodes + p.node;
        const float* upper = lower + cosine_nodes;
        const float below = lower[0] + p.fraction * (lower[1] - lower[0]);
        const float above = upper[0] + p.fraction * (upper[1] - upper[0]);
        return below + r.fraction * (above - below);
    }
    /// Returns the cosine-weighted average of `directional` over the hemisphere.
    [[nodiscard]] static float average(float roughness) noexcept
    {
        const NodePosition r = node_position(roughness * (average_nodes - 1), average_nodes);
        return averages[r.node] + r.fraction * (averages[r.node + 1] - averages[r.node]);
    }

private:
    static constexpr int cosine_nodes = 64;
    static constexpr int roughness_nodes = 32;
    static constexpr int average_nodes = 125;

    static const std::array<float, roughness_nodes * cosine_nodes> nodes;
    static const std::array<float, average_nodes> averages;
};

}  // namespace bdpt
