#pragma once

#include <algorithm>
#include <cstddef>

namespace bdpt {

/// Where a value lies among evenly spaced nodes: after which one, and how far.
struct NodePosition {
    std::size_t node;
    float fraction;
};

/// `scaled` is 0 at the first node and `nodes - 1` at the last one.
[[nodiscard]] inline NodePosition node_position(float scaled, int nodes)
{
    const int node = std::clamp(static_cast<int>(scaled), 0, nodes - 2);
    return {static_cast<std::size_t>(node), scaled - static_cast<float>(node)};
}

/// For the cosine-weighted average over the hemisphere of what is linear in x = sqrt(cosine)
/// between nodes of even x: calls `visit` with the first node of each interval, the interval's
/// share of the average (2 c dc = 4 x^3 dx), and how far in it the value lies that counts.
template <typename Visit>
void for_each_cosine_interval(int nodes, const Visit& visit)
{
    const float step = 1.0f / static_cast<float>(nodes - 1);
    for (int column = 0; column + 1 < nodes; ++column) {
        const float a = static_cast<float>(column) * step;
        const float b = a + step;
        const float whole = b * b * b * b - a * a * a * a;
        const float right = (0.8f * (b * b * b * b * b - a * a * a * a * a) - a * whole) / step;
        visit(column, whole, right / whole);
    }
}

}  // namespace bdpt
