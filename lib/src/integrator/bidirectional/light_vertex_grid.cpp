#include "integrator/bidirectional/light_vertex_grid.h"

#include "integrator/bidirectional/light_path_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace bdpt {
namespace {

/// Calls `visit` with each light path up to each of its vertices that can merge.
template <typename Visit>
void for_each_vertex(const LightPathCache& cache, const Visit& visit)
{
    cache.for_each_path([&](std::span<const PathVertex> path) {
        for (std::size_t size = 2; size <= path.size(); ++size) {
            if (path[size - 1].kind == VertexKind::surface && path[size - 1].connectible) {
                visit(path.first(size));
            }
        }
    });
}

}  // namespace

void LightVertexGrid::build(const LightPathCache& cache, Vec3 center, float radius)
{
    center_ = center;
    cells_per_meter_ = 0.5 / static_cast<double>(radius);
    radius_squared_ = radius * radius;
    std::size_t count = 0;
    for_each_vertex(cache, [&](std::span<const PathVertex>) { ++count; });
    entries_.resize(count);
    begins_.assign(std::bit_ceil(std::max<std::size_t>(count, 1)) + 1, 0);
    const auto bucket = [&](std::span<const PathVertex> light) {
        return bucket_of(cell_of(light.back().end.p, 0.0));
    };
    // A counting sort: stores each bucket's end, which becomes its begin as it is filled from its
    // end.
    for_each_vertex(cache, [&](std::span<const PathVertex> light) { ++begins_[bucket(light)]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    for_each_vertex(cache, [&](std::span<const PathVertex> light) {
        entries_[--begins_[bucket(light)]] = {.p = light.back().end.p,
                                              .size = static_cast<std::uint32_t>(light.size()),
                                              .path = light.data()};
    });
}

LightVertexGrid::Cell LightVertexGrid::cell_of(Vec3 p, double offset) const
{
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis) {
        const double way = static_cast<double>(p[axis]) - static_cast<double>(center_[axis]);
        cell[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(way * cells_per_meter_ + offset));
    }
    return cell;
}

std::size_t LightVertexGrid::bucket_of(const Cell& cell) const
{
    const std::uint64_t hash = static_cast<std::uint64_t>(cell[0]) * 73856093U ^
                               static_cast<std::uint64_t>(cell[1]) * 19349663U ^
                               static_cast<std::uint64_t>(cell[2]) * 83492791U;
    return static_cast<std::size_t>(hash) & (begins_.size() - 2);
}

std::array<std::size_t, 8> LightVertexGrid::buckets_near(Vec3 p) const
{
    // Cubes are as wide as the diameter of the search sphere, which overlaps at most two along each
    // axis.
    const Cell first = cell_of(p, -0.5);
    std::array<std::size_t, 8> buckets{};
    for (std::size_t i = 0; i < buckets.size(); ++i) {
        const auto bit = [i](std::size_t axis) {
            return static_cast<std::int64_t>(i >> axis & 1U);
        };
        const std::size_t bucket =
            bucket_of({first[0] + bit(0), first[1] + bit(1), first[2] + bit(2)});
        // Cubes may share a bucket, which must not be visited twice.
        const auto end = buckets.begin() + static_cast<std::ptrdiff_t>(i);
        buckets[i] = std::find(buckets.begin(), end, bucket) == end ? bucket : none;
    }
    return buckets;
}

}  // namespace bdpt
