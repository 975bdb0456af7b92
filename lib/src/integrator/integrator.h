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
struct TimeSheet;

/// Half-open rectangle of pixels.
struct Tile {
    int x_begin = 0;
    int x_end = 0;
    int y_begin = 0;
    int y_end = 0;
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
    /// Called on one thread before anything else of a pass of `samples`. Returns the number of
    /// chunks of work that all tiles of the pass share.
    [[nodiscard]] virtual std::int64_t begin_pass(SampleRange /*samples*/) { return 0; }
    /// Computes one of these chunks; all are done before any tile, by any threads. It may store
    /// data that tiles need, and add contributions to `films` that belong to no tile. Returns the
    /// amount of work.
    [[nodiscard]] virtual RenderStats render_chunk(std::int64_t /*part*/, SampleRange /*samples*/,
                                                   const Films& /*films*/)
    {
        return {};
    }
    /// Called on one thread between the last chunk of a pass and its tiles.
    virtual void end_chunks() {}
    /// Returns the group of a tile: those of one group use the same data, so that they are best
    /// rendered one after the other.
    [[nodiscard]] virtual std::uint32_t group(const Tile& /*tile*/) const { return 0; }
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
