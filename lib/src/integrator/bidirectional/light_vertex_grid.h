#pragma once

#include "path/path_vertex.h"

#include <glm/geometric.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

class LightPathCache;

/// Finds the light vertices near a point: a grid of cubes whose sides are the merge diameter,
/// stored in a hash table [Teschner et al. 2003, "Optimized Spatial Hashing for Collision Detection
/// of Deformable Objects"].
class LightVertexGrid {
    /// The last of the first `size` vertices of a light path.
    struct Entry {
        Vec3 p;
        std::uint32_t size;
        const PathVertex* path;
    };
    using Cell = std::array<std::int64_t, 3>;

public:
    /// Maximum memory per vertex: there are less than two buckets for each.
    static constexpr std::size_t bytes_of_vertex = 2 * sizeof(Entry) + 2 * sizeof(std::size_t);

    /// Sorts all vertices in `cache` that can merge into cells; their addresses must stay valid.
    /// Vertices at most `radius` apart are near. Coordinates are relative to `center`, for
    /// precision. Runs in parallel; the number of threads does not change the grid.
    void build(const LightPathCache& cache, Vec3 center, float radius);

    /// Calls `visit` with the light path up to each vertex near `p`, in an order that depends only
    /// on the arguments of `build`.
    template <typename Visit>
    void for_each_near(Vec3 p, const Visit& visit) const
    {
        for (const std::size_t bucket : buckets_near(p)) {
            if (bucket == none) {
                continue;
            }
            for (std::size_t i = begins_[bucket]; i < begins_[bucket + 1]; ++i) {
                const Entry& entry = entries_[i];
                const Vec3 offset = entry.p - p;
                if (dot(offset, offset) <= radius_squared_) {
                    visit(std::span(entry.path, entry.size));
                }
            }
        }
    }

private:
    static constexpr std::size_t none = ~std::size_t{0};

    [[nodiscard]] Cell find_cell(Vec3 p, double offset) const;
    [[nodiscard]] std::size_t find_bucket(const Cell& cell) const;
    /// Sorts the entries of a part, which begin at entry `first`, into its buckets `begins`.
    void sort_part(std::size_t first, std::span<const Entry> part, std::span<std::size_t> begins);
    /// Returns those of the eight cubes that have a point near `p`, without duplicates; the rest is
    /// `none`.
    [[nodiscard]] std::array<std::size_t, 8> buckets_near(Vec3 p) const;

    std::vector<Entry> entries_;       ///< sorted by bucket
    std::vector<Entry> parted_;        ///< sorted by part of the buckets, while the grid is built
    std::vector<std::size_t> begins_;  ///< first entries of buckets, plus the end of the last
    Vec3 center_{0.0f};
    double cells_per_meter_ = 1.0;
    float radius_squared_ = 0.0f;
};

}  // namespace bdpt
