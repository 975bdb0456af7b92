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

class EnvironmentVisibility;
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

/// Where an integrator adds what it finds.
struct Films {
    Film* film;  ///< null: nothing is kept, and observers are told of the paths of all pixels
    StrategyFilm& strategies;  ///< empty unless images of strategies are asked for
    /// Told of each path that brings light, if there is one.
    const std::function<void(const PathContribution&)>& on_path;
    /// Where the time of samples is noted, if it is to be.
    TimeSheet* times = nullptr;
};

/// A light transport algorithm at work on one render. Const while tiles are rendered: every thread
/// calls the same object.
class Integrator {
public:
    virtual ~Integrator() = default;
    /// Sample indices that a pass may have at most.
    [[nodiscard]] virtual std::int64_t max_samples_in_pass() const
    {
        return std::numeric_limits<std::int64_t>::max();
    }
    /// Called on one thread before anything else of a pass of `samples`. Returns in how many parts
    /// the integrator does what all tiles of the pass share.
    [[nodiscard]] virtual std::int64_t begin_pass(SampleRange /*samples*/) { return 0; }
    /// One of these parts; all are done before any tile, by any threads. It may keep what tiles
    /// need, and add to `films` what belongs to none of them. Returns the work that it was.
    [[nodiscard]] virtual RenderStats render_chunk(std::int64_t /*part*/, SampleRange /*samples*/,
                                                   const Films& /*films*/)
    {
        return {};
    }
    /// Called on one thread between the last part of a pass and its tiles.
    virtual void end_chunks() {}
    /// Adds the samples of all pixels of `tile` that are in the film's region to `films`, and what
    /// the light paths of all of its pixels splat anywhere. Tiles of an integrator without splats
    /// lie inside of the region. Returns the work that it was.
    [[nodiscard]] virtual RenderStats render_tile(const Tile& tile, SampleRange samples,
                                                  const Films& films) const = 0;
};

/// `options` have been checked. The world, the camera and what is known of the visibility of its
/// environment (null: nothing) must outlive the integrator.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(
    const World& world, const MovingCamera& camera, const RenderOptions& options,
    const EnvironmentVisibility* visibility = nullptr);

}  // namespace bdpt
