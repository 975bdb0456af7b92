#include "scene/contacts/mesh_topology.h"

#include "math/random_numbers.h"

#include <glm/geometric.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace bdpt {
namespace {

/// An edge of a triangle.
struct HalfEdge {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t triangle;
    std::uint32_t apex;  ///< the opposite vertex
    int way;             ///< +1 from the lower to the higher vertex
};

/// Returns the edges of all triangles with three vertices, equal ones side by side.
std::vector<HalfEdge> sorted_edges(const MeshDesc& mesh, const std::vector<std::uint32_t>& first)
{
    // A counting sort by the lower vertex, as a mesh may have millions.
    const auto for_each_half_edge = [&](const auto& visit) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const UVec3& triangle = mesh.triangles[t];
            const std::array v{first[triangle.x], first[triangle.y], first[triangle.z]};
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
                continue;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = v[i];
                const std::uint32_t b = v[(i + 1) % 3];
                visit(HalfEdge{.low = std::min(a, b),
                               .high = std::max(a, b),
                               .triangle = static_cast<std::uint32_t>(t),
                               .apex = v[(i + 2) % 3],
                               .way = a < b ? 1 : -1});
            }
        }
    };
    std::vector<std::size_t> ends(mesh.positions.size() + 1);  // by lower vertex
    for_each_half_edge([&](const HalfEdge& edge) { ++ends[edge.low + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<HalfEdge> edges(ends.back());
    for_each_half_edge([&](const HalfEdge& edge) { edges[ends[edge.low]++] = edge; });
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 4096), [&](const auto& range) {
            for (std::size_t v = range.begin(); v != range.end(); ++v) {
                const auto begin = static_cast<std::ptrdiff_t>(v > 0 ? ends[v - 1] : 0);
                std::sort(edges.begin() + begin,
                          edges.begin() + static_cast<std::ptrdiff_t>(ends[v]),
                          [](const HalfEdge& a, const HalfEdge& b) {
                              return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
                          });
            }
        });
    return edges;
}

/// Calls `visit` with the edges between the same two vertices, for all such groups.
template <typename Visit>
void for_each_edge(const std::vector<HalfEdge>& edges, const Visit& visit)
{
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin;
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high) {
            ++end;
        }
        visit(std::span(edges).subspan(begin, end - begin));
        begin = end;
    }
}

/// Disjoint sets of triangles.
class TriangleSets {
public:
    explicit TriangleSets(std::size_t count) : parents_(count)
    {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    std::uint32_t find(std::uint32_t item)
    {
        while (parents_[item] != item) {
            parents_[item] = parents_[parents_[item]];
            item = parents_[item];
        }
        return item;
    }
    void unite(std::uint32_t a, std::uint32_t b) { parents_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parents_;
};

/// Returns for each edge of a group a number in [-2, 2] that grows with the angle of its triangle
/// around the edge.
std::vector<float> compute_angles(const MeshDesc& mesh, std::span<const HalfEdge> group)
{
    const Vec3 low = mesh.positions[group[0].low];
    const Vec3 along = normalize(mesh.positions[group[0].high] - low);
    const auto across = [&](const HalfEdge& edge) {
        const Vec3 to_apex = mesh.positions[edge.apex] - low;
        return to_apex - along * dot(along, to_apex);
    };
    const Vec3 x = across(group[0]);
    const Vec3 y = cross(along, x);
    std::vector<float> angles;
    angles.reserve(group.size());
    for (const HalfEdge& edge : group) {
        const Vec3 v = across(edge);
        const float c = dot(v, x);
        const float s = dot(v, y);
        const float size = std::abs(c) + std::abs(s);
        const float turn = size > 0.0f ? c / size : 1.0f;
        angles.push_back(s < 0.0f ? turn - 1.0f : 1.0f - turn);
    }
    return angles;
}

/// Connects pairs of triangles that bound a wedge of the inside: the back of each faces the other.
/// The rest of `group` stays open.
template <typename Connect>
void connect_wedges(const MeshDesc& mesh, std::span<const HalfEdge> group, const Connect& connect)
{
    constexpr float full = 4.0f;
    constexpr float coplanar = 1e-3f;  // such a wedge has no inside: two bodies touch there
    const std::vector<float> angles = compute_angles(mesh, group);
    std::vector<bool> taken(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i].way < 0) {
            continue;
        }
        std::optional<std::size_t> nearest;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < group.size(); ++k) {
            float wedge = angles[i] - angles[k];
            wedge += wedge < coplanar ? full : 0.0f;
            wedge += wedge < coplanar ? full : 0.0f;
            if (group[k].way < 0 && !taken[k] && wedge < least) {
                least = wedge;
                nearest = k;
            }
        }
        if (nearest) {
            taken[*nearest] = true;
            connect(group[i], group[*nearest]);
        }
    }
}

struct ShellExtent {
    Bounds box = empty_bounds();
    Vec3 apex{0.0f};      // of the tetrahedra whose signed volumes are summed
    double volume = 0.0;  // [m^3], of a closed shell
    double area = 0.0;    // [m^2]
};

std::vector<ShellExtent> measure(const PlacedMesh& placed, const Shells& shells)
{
    std::vector<ShellExtent> extents(shells.are_closed.size());
    for (std::uint32_t t = 0; t < placed.triangle_count(); ++t) {
        ShellExtent& extent = extents[shells.of_triangles[t]];
        const auto corners = placed.corners(t, 0.0f);
        if (extent.box.min.x > extent.box.max.x) {
            extent.apex = corners[0];
        }
        const Vec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        extent.box = joined(extent.box, box_around(corners, 0.0f));
        extent.area += 0.5 * double{length(area)};
        extent.volume += double{dot(area, corners[0] - extent.apex)} / 6.0;
    }
    return extents;
}

bool may_be_thin(const ShellExtent& shell, bool is_closed)
{
    constexpr float max_exact = 1e-5f;     // error in sizes of a shell
    constexpr double max_errors = 1000.0;  // in its mean thickness
    const float error = error_in(shell.box);
    const double mean_thickness = 2.0 * std::abs(shell.volume) / shell.area;
    return error > max_exact * distance(shell.box.min, shell.box.max) &&
           !(is_closed && mean_thickness > max_errors * double{error});
}

}  // namespace

std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions)
{
    struct Place {
        std::uint64_t hash;
        std::uint32_t vertex;
        auto operator<=>(const Place&) const = default;
    };
    std::vector<Place> order(positions.size());
    tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
        const Vec3 p = positions[i] + 0.0f;  // one zero
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            hash = split_mix(hash + std::bit_cast<std::uint32_t>(p[axis]));
        }
        order[i] = {hash, static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<std::uint32_t> result(positions.size());
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        for (end = begin; end < order.size() && order[end].hash == order[begin].hash; ++end) {
            // Nearly always the first of those with this hash.
            std::size_t same = begin;
            while (positions[order[same].vertex] != positions[order[end].vertex]) {
                ++same;
            }
            result[order[end].vertex] = order[same].vertex;
        }
    }
    return result;
}

Shells find_shells(const MeshDesc& mesh)
{
    const std::vector<HalfEdge> edges = sorted_edges(mesh, weld(mesh.positions));
    TriangleSets sets(mesh.triangles.size());
    std::vector<int> open_edges(mesh.triangles.size(), 3);  // by triangle
    const auto connect = [&](const HalfEdge& a, const HalfEdge& b) {
        sets.unite(a.triangle, b.triangle);
        --open_edges[a.triangle];
        --open_edges[b.triangle];
    };
    Shells shells;
    for_each_edge(edges, [&](std::span<const HalfEdge> group) {
        int balance = 0;
        for (const HalfEdge& edge : group) {
            balance += edge.way;
        }
        shells.open_edges += balance != 0 ? 1 : 0;
        if (group.size() == 2 && group[0].way != group[1].way) {
            connect(group[0], group[1]);
        } else if (group.size() > 1) {
            connect_wedges(mesh, group, connect);
        }
    });
    std::vector<std::uint32_t> numbers(mesh.triangles.size(),
                                       std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::uint32_t& number = numbers[sets.find(t)];
        if (number == std::numeric_limits<std::uint32_t>::max()) {
            number = static_cast<std::uint32_t>(shells.are_closed.size());
            shells.are_closed.push_back(true);
        }
        shells.of_triangles.push_back(number);
        if (open_edges[t] > 0) {
            shells.are_closed[number] = false;
        }
    }
    return shells;
}

float error_in(const Bounds& box)
{
    const Vec3 farthest = max(abs(box.min), abs(box.max));
    return position_error(std::max({farthest.x, farthest.y, farthest.z}));
}

ShellNeighbors::ShellNeighbors(const PlacedMesh& placed, const Shells& shells, float margin)
    : margin_(margin)
{
    std::vector<Bounds> boxes;
    for (const ShellExtent& extent : measure(placed, shells)) {
        may_be_thin_.push_back(may_be_thin(extent, shells.are_closed[boxes.size()]));
        any_ = any_ || may_be_thin_.back();
        boxes.push_back(extent.box);
    }
    boxes_ = BoxTree(std::move(boxes));
    for (const Bounds& box : boxes_.boxes()) {
        const float far = margin * error_in(box);
        const auto shell = static_cast<std::uint32_t>(has_near_.size());
        has_near_.push_back(overlaps_other({.min = box.min - far, .max = box.max + far}, shell));
        any_ = any_ || has_near_.back();
    }
}

bool ShellNeighbors::overlaps_other(const Bounds& box, std::uint32_t shell) const
{
    bool overlaps = false;
    boxes_.find(box, [&](std::uint32_t other) {
        overlaps = other != shell;
        return !overlaps;
    });
    return overlaps;
}

}  // namespace bdpt
