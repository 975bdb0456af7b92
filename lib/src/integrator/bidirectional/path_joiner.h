#pragma once

#include "integrator/contribution_sink.h"
#include "path/subpath.h"

namespace bdpt {

/// The heart of bidirectional path tracing [Veach 1997, ch. 10]: joins every prefix of a camera
/// subpath to every prefix of light subpaths, weighs what is found and hands it to the sink. Works
/// for one thread.
class PathJoiner {
public:
    /// All must outlive this.
    PathJoiner(const RenderOptions& options, const StrategySet& strategies, PathWeigher& weigher,
               ContributionSink& sink)
        : options_(options), strategies_(strategies), weigher_(weigher), sink_(sink)
    {}

    /// s <= 1: the camera path hits lights, and is joined to fresh points of them. Comes before
    /// `join_paths` with the same path.
    void join_camera_path(SampleContext& sample, Subpath& path);
    /// t <= 1: vertices of a light path are seen through the lens, or it crosses the lens. Comes
    /// before `join_paths` with the same path, which may be kept in between.
    void join_light_path(SampleContext& sample, Subpath& path);
    /// s >= 2, t >= 2
    void join_paths(const SampleContext& sample, std::span<const PathVertex> light,
                    const Subpath& camera);

private:
    void join_to_lights(SampleContext& sample, std::span<const PathVertex> camera);
    /// Is a path of one edge to `x0` left out?
    [[nodiscard]] bool is_background(const SampleContext& sample, const PathVertex& x0) const;

    const RenderOptions& options_;
    const StrategySet& strategies_;
    PathWeigher& weigher_;
    ContributionSink& sink_;
};

}  // namespace bdpt
