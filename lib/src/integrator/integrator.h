#pragma once

#include <bdpt/film/film.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

namespace bdpt {

struct LearnedLight;
class MovingCamera;
class World;

/// Half-open rectangle of pixels.
struct Tile {
    int x_begin = 0;
    int x_end = 0;
    int y_begin = 0;
    int y_end = 0;
};

/// Half-open range of chunks of work.
struct ChunkRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;
};

/// Destinations of an integrator's contributions.
struct Films {
    Film* film;  ///< null: nothing is stored, and observers receive the paths of all pixels
    StrategyFilm& strategies;  ///< empty unless strategy images are requested
    /// Called for each path that contributes light, if set.
    const std::function<void(const PathContribution&)>& on_path;
};

/// A light transport algorithm working on one render. Const while tiles are rendered: all threads
/// call the same object.
class Integrator {
public:
    virtual ~Integrator() = default;
    /// Returns the maximum number of sample indices in a pass.
    [[nodiscard]] virtual std::int64_t max_samples_in_pass() const
    {
        return std::numeric_limits<std::int64_t>::max();
    }
    /// Returns the number of batches of a pass. Each begins, computes its chunks and then its
    /// tiles, before the next one begins.
    [[nodiscard]] virtual std::int64_t batches() const { return 1; }
    /// Called on one thread before anything else of a batch of the pass of `samples`. Returns the
    /// chunks of work that all tiles of the batch share.
    [[nodiscard]] virtual ChunkRange begin_batch(SampleRange /*samples*/, std::int64_t /*batch*/)
    {
        return {};
    }
    /// Computes one of these chunks; all are done before any tile, by any threads. It may store
    /// data that tiles need, and add contributions to `films` that belong to no tile. Returns the
    /// amount of work.
    [[nodiscard]] virtual RenderStats render_chunk(std::int64_t /*part*/, SampleRange /*samples*/,
                                                   const Films& /*films*/)
    {
        return {};
    }
    /// Called on one thread between the last chunk of a batch and its tiles.
    virtual void end_chunks() {}
    /// Returns the side of square tiles [pixels] that is wanted, or a smaller one: pixels of a tile
    /// must belong to one batch.
    [[nodiscard]] virtual int tile_side(int wanted) const { return wanted; }
    /// Returns the batch of a tile.
    [[nodiscard]] virtual std::int64_t batch(const Tile& /*tile*/) const { return 0; }
    /// Returns the group of a tile: those of one group use the same data, so that they are best
    /// rendered one after the other. Groups of later batches are greater.
    [[nodiscard]] virtual std::int64_t group(const Tile& /*tile*/) const { return 0; }
    /// Adds to `films` the samples of all pixels of `tile` that are in the film's region, and the
    /// splats of the light paths of all of its pixels. Tiles of an integrator without splats lie
    /// inside of the region. Returns the amount of work.
    [[nodiscard]] virtual RenderStats render_tile(const Tile& tile, SampleRange samples,
                                                  const Films& films) const = 0;
};

/// `options` have been checked. The world, the camera and what is known of the light of its
/// environment (null: nothing) must outlive the integrator.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(const World& world,
                                                          const MovingCamera& camera,
                                                          const RenderOptions& options,
                                                          const LearnedLight* learned = nullptr);

}  // namespace bdpt
