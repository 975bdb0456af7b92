#pragma once

#include "integrator/bidirectional/connection_chooser.h"
#include "integrator/bidirectional/light_path_cache.h"
#include "integrator/bidirectional/pixel_groups.h"
#include "integrator/contribution_sink.h"
#include "path/subpath.h"

namespace bdpt {

/// The core of bidirectional path tracing [Veach 1997, ch. 10]: connects every prefix of a camera
/// subpath to every prefix of light subpaths, weights the contributions and passes them to the
/// sink. For one thread.
class PathJoiner {
public:
    /// Keeps references to all arguments, which must outlive this.
    PathJoiner(const RenderOptions& options, const StrategySet& strategies, PathWeigher& weigher,
               ContributionSink& sink)
        : options_(options),
          strategies_(strategies),
          weigher_(weigher),
          sink_(sink),
          chooser_(options),
          light_to_lens_pixels_(strategies.count(1, 1), options.film.width, options.film.height)
    {}

    /// Handles s <= 1: the camera path hits lights, and is connected to new points on lights. Must
    /// precede `join_paths` with the same path.
    void join_camera_path(SampleContext& sample, Subpath& path);
    /// Handles t <= 1: vertices of a light path are connected to the lens, or the path crosses the
    /// lens. Must precede `join_paths` with the same path, which may be cached in between.
    void join_light_path(SampleContext& sample, Subpath& path);
    /// Handles s >= 2, t >= 2.
    void join_paths(const SampleContext& sample, std::span<const PathVertex> light,
                    const Subpath& camera);
    /// Handles s >= 2, t >= 2 for all light paths of the choice by connections that are chosen.
    void join_chosen(const SampleContext& sample, const LightPathCache& cache,
                     const LightPathCache::Choice& choice, const Subpath& camera);
    /// Decides at random whether the camera path of a sample of pixel (x, y) connects a point on a
    /// light to the lens.
    [[nodiscard]] bool connects_light_to_lens(const Sampler& sampler, int x, int y) const;
    /// Returns the pixels whose samples ever connect a light to the lens.
    [[nodiscard]] const SparsePixels& light_to_lens_pixels() const { return light_to_lens_pixels_; }

private:
    void join_to_lights(SampleContext& sample, std::span<const PathVertex> camera);
    /// Tests whether a path of one edge to `x0` is excluded as background.
    [[nodiscard]] bool is_background(const SampleContext& sample, const PathVertex& x0) const;

    const RenderOptions& options_;
    const StrategySet& strategies_;
    PathWeigher& weigher_;
    ContributionSink& sink_;
    ConnectionChooser chooser_;
    SparsePixels light_to_lens_pixels_;
};

}  // namespace bdpt
