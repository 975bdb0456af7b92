#include "integrator/bidirectional/light_vertex_grid.h"

#include "integrator/bidirectional/light_path_cache.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace bdpt {
namespace {

/// Numbers of blocks of light paths that are read in parallel, and of parts of the buckets that are
/// filled in parallel.
constexpr std::size_t blocks = 64;
constexpr std::size_t max_parts = 64;

/// Calls `visit` with each light path of the block up to each of its vertices that can merge. The
/// blocks together hold all light paths of the cache, in order.
template <typename Visit>
void for_each_vertex(const LightPathCache& cache, std::size_t block, const Visit& visit)
{
    const auto find_begin = [&cache](std::size_t number) {
        return cache.chunks() * static_cast<std::int64_t>(number) /
               static_cast<std::int64_t>(blocks);
    };
    cache.for_each_path(
        find_begin(block), find_begin(block + 1), [&](std::span<const PathVertex> path) {
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
    std::array<std::size_t, blocks> counts{};
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t found = 0;
        for_each_vertex(cache, block, [&](std::span<const PathVertex>) { ++found; });
        counts[block] = found;
    });
    const std::size_t count = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(count, 1));
    begins_.resize(buckets + 1);
    begins_[buckets] = count;
    parted_.resize(count);
    entries_.resize(count);

    // Each part has neighbouring buckets, and their entries in the order of the light paths.
    const std::size_t parts = std::min(buckets, max_parts);
    const std::size_t buckets_of_part = buckets / parts;
    using Places = std::array<std::size_t, max_parts>;
    std::vector<Places> places(blocks);
    const auto bucket = [&](Vec3 p) { return find_bucket(find_cell(p, 0.0)); };
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        Places found{};
        for_each_vertex(cache, block, [&](std::span<const PathVertex> light) {
            ++found[bucket(light.back().end.p) / buckets_of_part];
        });
        places[block] = found;
    });
    Places begins{};
    std::size_t next = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        begins[part] = next;
        for (Places& of_block : places) {
            next += std::exchange(of_block[part], next);
        }
    }
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        Places at = places[block];
        for_each_vertex(cache, block, [&](std::span<const PathVertex> light) {
            const Vec3 p = light.back().end.p;
            parted_[at[bucket(p) / buckets_of_part]++] = {
                .p = p, .size = static_cast<std::uint32_t>(light.size()), .path = light.data()};
        });
    });
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
        const std::size_t end = part + 1 < parts ? begins[part + 1] : count;
        sort_part(begins[part], std::span(parted_).subspan(begins[part], end - begins[part]),
                  std::span(begins_).subspan(part * buckets_of_part, buckets_of_part));
    });
}

/// A counting sort: stores each bucket's end, which becomes its begin as it is filled from its end.
void LightVertexGrid::sort_part(std::size_t first, std::span<const Entry> part,
                                std::span<std::size_t> begins)
{
    const auto bucket = [&](const Entry& entry) -> std::size_t& {
        return begins[find_bucket(find_cell(entry.p, 0.0)) & (begins.size() - 1)];
    };
    std::fill(begins.begin(), begins.end(), std::size_t{0});
    for (const Entry& entry : part) {
        ++bucket(entry);
    }
    std::size_t end = first;
    for (std::size_t& begin : begins) {
        end += begin;
        begin = end;
    }
    for (const Entry& entry : part) {
        entries_[--bucket(entry)] = entry;
    }
}

LightVertexGrid::Cell LightVertexGrid::find_cell(Vec3 p, double offset) const
{
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis) {
        const double way = static_cast<double>(p[axis]) - static_cast<double>(center_[axis]);
        cell[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(way * cells_per_meter_ + offset));
    }
    return cell;
}

std::size_t LightVertexGrid::find_bucket(const Cell& cell) const
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
    const Cell first = find_cell(p, -0.5);
    std::array<std::size_t, 8> buckets{};
    for (std::size_t i = 0; i < buckets.size(); ++i) {
        const auto bit = [i](std::size_t axis) {
            return static_cast<std::int64_t>(i >> axis & 1U);
        };
        const std::size_t bucket =
            find_bucket({first[0] + bit(0), first[1] + bit(1), first[2] + bit(2)});
        // Cubes may share a bucket, which must not be visited twice.
        const auto end = buckets.begin() + static_cast<std::ptrdiff_t>(i);
        buckets[i] = std::find(buckets.begin(), end, bucket) == end ? bucket : none;
    }
    return buckets;
}

}  // namespace bdpt
