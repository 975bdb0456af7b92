#pragma once

#include "integrator/bidirectional/pixel_groups.h"
#include "integrator/integrator.h"
#include "integrator/sample_schedule.h"
#include "math/low_level.h"
#include "memory/huge_page_pool.h"
#include "path/path_vertex.h"
#include "path/strategy_set.h"
#include "path/subpath.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bdpt {

/// What the choice of connections needs to know of four vertices of light paths.
struct LightVertexBlock {
    static constexpr std::size_t size = 4;

    Float4 x, y, z;           ///< position [m]
    Float4 nx, ny, nz;        ///< normal if the vertex scatters on one side of it only; else zero
    Float4 any_side;          ///< 1 if the vertex scatters to all sides; else 0
    Float4 red, green, blue;  ///< `estimated_power` of the vertex; 0 if there is none
    Float4 area;              ///< `nearby_area` of the vertex [m^2]
    Int4 s;                   ///< number of vertices of the light path up to this one
    std::array<std::uint32_t, size> path_begin;  ///< index of the path's first vertex in its chunk
    std::array<std::uint32_t, size> path;        ///< number of the light path in its bundle

    /// Fills entry `i` with the last of the path's first `s` vertices. `count` is the mean number
    /// of light paths that a camera path is connected to.
    void set(std::size_t i, std::span<const PathVertex> light, double count);
};

/// Tests whether a connection can be chosen at this vertex of a light or camera path.
[[nodiscard]] inline bool can_choose(const PathVertex& vertex)
{
    return scatters(vertex.kind) && vertex.connectible;
}

/// Returns the throughput of the scattered light if the base colour is the albedo; a dielectric
/// with a black base reflects some light, too.
[[nodiscard]] Rgb estimated_power(const PathVertex& vertex);

/// Returns 1 / (pi count pdf) for the last vertex of a subpath, where `pdf` is its density [1/m^2].
/// If two connected vertices are nearer to each other than the root of this area, a walk from the
/// other side finds the vertex more often than `count` connections do, and has most of the MIS
/// weight. 0 if no strategy does without the vertex's own walk.
[[nodiscard]] float nearby_area(std::span<const PathVertex> subpath, double count);

class Sampler;

/// Light paths of one sample index, shared by the camera paths of all pixels. They are a pure
/// function of (options, seed, index).
class LightPathCache {
public:
    /// Light paths `first` to `first` + `count` - 1 of a bundle, wrapping around its end.
    struct Choice {
        std::int64_t bundle = 0;
        int first = 0;
        int count = 0;
    };
    /// Number of bundles that one thread fills together.
    static constexpr std::int64_t chunk_bundles = 64;

    /// `options` have been checked.
    LightPathCache(const LightPathCounts& counts, const RenderOptions& options);

    /// Returns a bound that the mean number of vertices of light paths hardly exceeds: Russian
    /// roulette ends most paths soon after it begins. Without roulette, the maximum.
    [[nodiscard]] static int usual_vertices(const RenderOptions& options);
    /// Returns the memory of the cache, which holds one batch, [bytes] for that mean number of
    /// vertices per light path.
    [[nodiscard]] static std::uint64_t bytes(const LightPathCounts& counts, double mean_vertices);

    [[nodiscard]] const LightPathCounts& counts() const { return counts_; }
    [[nodiscard]] std::int64_t chunks() const
    {
        return (counts_.bundles + chunk_bundles - 1) / chunk_bundles;
    }
    /// Returns the chunks to be filled for the batch, in the memory of the batch before it. The last
    /// chunk of that one stays, as it may have bundles of both. Batches begin in order.
    [[nodiscard]] ChunkRange begin_batch(std::int64_t batch);
    /// Returns the batch that has the light paths of the pixel.
    [[nodiscard]] std::int64_t batch(int x, int y) const
    {
        return groups_.part(x, y, group_seed_, counts_.batches);
    }
    /// Returns the random numbers of light path `which` of a bundle of sample `index`: those of a
    /// bundle, over all indices, form one sequence, as a camera path is connected to several of
    /// them.
    [[nodiscard]] Sampler sampler(std::int64_t index, std::int64_t bundle, int which) const;

    // Filling: a chunk is begun, receives its bundles in order, each with its light paths, and is
    // ended. Different threads may fill different chunks.
    void begin_chunk(std::int64_t chunk);
    void add_bundle(std::int64_t chunk, const TimeAndWavelength& moment);
    void add_path(std::int64_t chunk, std::span<const PathVertex> path);
    void end_chunk(std::int64_t chunk);

    /// Chooses the light paths to which the camera path of `sample` of pixel (x, y) is connected.
    /// They are evenly distributed over the image, and far apart for neighbouring pixels, but all
    /// in the part of the light paths that belongs to the pixel's group. All rounds of the pixel
    /// use light paths of the same bundle, which are as well distributed over the rounds as a
    /// pixel's own; samples within a round use different bundles.
    [[nodiscard]] Choice choose(int x, int y, const ScheduledSample& sample) const;
    [[nodiscard]] const PixelGroups& groups() const { return groups_; }
    /// Returns the part of the light paths that has those of the pixel; there are `groups`.
    [[nodiscard]] std::int64_t part(int x, int y) const
    {
        return groups_.part(x, y, group_seed_, groups_.groups());
    }
    /// Prefetches the light paths of the choice, or their blocks where connections are chosen: they
    /// are scattered over more memory than a processor's cache holds.
    void prefetch(const Choice& choice) const;
    /// Prefetches what a connection needs of a vertex of a light path, but for its BSDF.
    static void prefetch_vertex(const PathVertex& vertex);
    /// Returns time and wavelength of a bundle's light paths, and of the camera paths that are
    /// connected to them.
    [[nodiscard]] const TimeAndWavelength& moment(std::int64_t bundle) const
    {
        return find_chunk(bundle).moments[index_in_chunk(bundle)];
    }
    /// Visits the light paths of the chunks [first, last) in order.
    template <typename Visit>
    void for_each_path(std::int64_t first, std::int64_t last, const Visit& visit) const
    {
        for (std::int64_t number = first; number < last; ++number) {
            const Chunk& chunk = chunk_at(number);
            std::size_t begin = 0;
            for (const PathEnd& end : chunk.path_ends) {
                visit(std::span(chunk.vertices).subspan(begin, end.vertices - begin));
                begin = end.vertices;
            }
        }
    }
    /// Returns the vertices of all light paths of the choice, which comprises a whole bundle, for
    /// the choice of connections.
    [[nodiscard]] std::span<const LightVertexBlock> blocks(const Choice& choice) const;
    /// Returns the first `size` vertices of the path in the bundle of the choice that begins at
    /// `begin`, as in `LightVertexBlock`.
    [[nodiscard]] std::span<const PathVertex> prefix(const Choice& choice, std::uint32_t begin,
                                                     int size) const
    {
        return std::span(find_chunk(choice.bundle).vertices)
            .subspan(begin, static_cast<std::size_t>(size));
    }
    /// Returns light path number `which` of the choice; empty if no light has power.
    [[nodiscard]] std::span<const PathVertex> path(const Choice& choice, int which) const;

private:
    /// The end of a path in the arrays of its chunk, where the next one begins.
    struct PathEnd {
        std::size_t vertices = 0;
        std::size_t bsdfs = 0;
    };
    template <typename T>
    using PooledVector = std::vector<T, PoolAllocator<T>>;
    /// In cache lines of its own, as threads fill different chunks.
    struct alignas(HugePagePool::cache_line) Chunk {
        PooledVector<TimeAndWavelength> moments;  // one per bundle
        PooledVector<PathEnd> path_ends;
        PooledVector<PathVertex> vertices;  // one path after another
        PooledVector<Bsdf> bsdfs;           // BSDFs of the connectible vertices, in order
        // If connections are chosen: the blocks of one bundle after another, the first of each, and
        // the number of vertices in the last block.
        PooledVector<LightVertexBlock> blocks;
        PooledVector<std::size_t> bundle_begins;
        std::size_t in_last_block = LightVertexBlock::size;

        explicit Chunk(HugePagePool& pool)
            : moments(PoolAllocator<TimeAndWavelength>(pool)),
              path_ends(PoolAllocator<PathEnd>(pool)),
              vertices(PoolAllocator<PathVertex>(pool)),
              bsdfs(PoolAllocator<Bsdf>(pool)),
              blocks(PoolAllocator<LightVertexBlock>(pool)),
              bundle_begins(PoolAllocator<std::size_t>(pool))
        {}
        [[nodiscard]] PathEnd path_begin(std::size_t path) const
        {
            return path == 0 ? PathEnd{} : path_ends[path - 1];
        }
    };
    /// Adds the vertices of the next path of the chunk to the blocks of its bundle.
    void add_to_blocks(Chunk& chunk, std::span<const PathVertex> path);
    [[nodiscard]] const Chunk& find_chunk(std::int64_t bundle) const
    {
        return chunk_at(bundle / chunk_bundles);
    }
    [[nodiscard]] const Chunk& chunk_at(std::int64_t number) const
    {
        return chunks_[static_cast<std::size_t>(number - first_)];
    }
    [[nodiscard]] Chunk& chunk_at(std::int64_t number)
    {
        return chunks_[static_cast<std::size_t>(number - first_)];
    }
    [[nodiscard]] static std::size_t index_in_chunk(std::int64_t bundle)
    {
        return static_cast<std::size_t>(bundle % chunk_bundles);
    }
    /// Returns the index of light path `which` of the choice in its chunk.
    [[nodiscard]] std::size_t find_path(const Choice& choice, int which) const
    {
        return index_in_chunk(choice.bundle) * static_cast<std::size_t>(counts_.bundle) +
               static_cast<std::size_t>((choice.first + which) % counts_.bundle);
    }

    LightPathCounts counts_;
    PixelGroups groups_;
    SamplerKind kind_;
    std::uint64_t seed_;
    std::uint32_t group_seed_;
    std::unique_ptr<HugePagePool> pool_ = std::make_unique<HugePagePool>();
    std::vector<Chunk> chunks_;  // as many as the largest batch has
    std::int64_t first_ = 0;     // number of the first of them
};

}  // namespace bdpt
