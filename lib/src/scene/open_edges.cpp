#include "scene/open_edges.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace bdpt {
namespace {

/// Returns for each vertex the first one, in a fixed order, at the same position.
std::vector<std::uint32_t> welded(const std::vector<Vec3>& positions)
{
    const auto place = [&](std::uint32_t i) {
        return std::tuple(positions[i].x, positions[i].y, positions[i].z);
    };
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    std::vector<std::uint32_t> result(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        result[order[i]] = same ? result[order[i - 1]] : order[i];
    }
    return result;
}

struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    int way;  ///< +1 from the lower to the higher vertex
};

}  // namespace

std::size_t count_open_edges(const MeshDesc& mesh)
{
    const std::vector<std::uint32_t> first = welded(mesh.positions);
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const UVec3& triangle : mesh.triangles) {
        const std::uint32_t v[] = {first[triangle.x], first[triangle.y], first[triangle.z]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            continue;
        }
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = v[i];
            const std::uint32_t b = v[(i + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    }
    const auto key = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        int balance = 0;
        const std::size_t begin = i;
        for (; i < edges.size() && key(edges[i]) == key(edges[begin]); ++i) {
            balance += edges[i].way;
        }
        open += balance != 0 ? 1 : 0;
    }
    return open;
}

}  // namespace bdpt
