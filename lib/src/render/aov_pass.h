#pragma once

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "integrator/integrator.h"
#include "render/ground/ground_shadow.h"
#include "scene/scene_names.h"

#include <bdpt/film/aov_film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/scene.h>

#include <optional>
#include <vector>

namespace bdpt {

/// The part of the film where a camera sees the scene: a rectangle around its bounds.
class SceneOutline {
public:
    SceneOutline(const MovingCamera& camera, const Bounds& bounds);

    /// Tests whether all camera rays through `area` miss every surface. False if that is unknown:
    /// for a camera that moves, has a finite lens, or has a corner of the bounds behind it.
    [[nodiscard]] bool is_beside(const RasterBounds& area) const noexcept;

private:
    std::optional<RasterBounds> outline_;  // nullopt if unknown
};

/// Traces the camera rays of a render once more, at their own times, up to the first surface or the
/// ground: the same for every integrator.
class AovPass {
public:
    /// Keeps references to `world` and `camera`, which must outlive this.
    AovPass(const World& world, const MovingCamera& camera, const RenderOptions& options);
    /// Adds the samples of the pixels of `tile` that are in the films' region. Returns the amount
    /// of work.
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples, AovFilm& film,
                                          IdFilm& ids) const;
    /// Returns the names of surfaces that rays may hit, if ids were requested.
    [[nodiscard]] IdNames names() const;

private:
    /// Adds a sample; appends to `met` the ids of the surface that the ray hits, if ids were
    /// requested.
    void add_sample(int x, int y, std::int64_t sample_index, AovFilm& film,
                    std::vector<SurfaceIds>& met, RayCounts& rays) const;
    /// Adds samples of a pixel whose camera rays all hit the ground and miss the scene.
    void add_ground(int x, int y, SampleRange samples, const GroundShadow::Part& ground,
                    AovFilm& film, RayCounts& rays) const;
    /// Returns the ground that the camera rays through `footprint` hit.
    [[nodiscard]] std::optional<GroundShadow::Part> ground_in(const RasterBounds& footprint) const;

    /// Returns the first surface that the camera ray hits. Of the rays that pass tinted surfaces
    /// alone, a share hits the first of these, so that alpha is the light that they absorb.
    [[nodiscard]] std::optional<RayHit> hit_of(const CameraRay& ray, SegmentKey segment,
                                               Sampler& sampler, RayCounts& rays) const;
    /// Returns the fraction of light that surfaces block along a camera ray, in [0, 1].
    [[nodiscard]] float opacity_along(const CameraRay& ray, SegmentKey segment,
                                      RayCounts& rays) const;

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
    bool needs_surfaces_;
    SceneOutline outline_;
    GroundShadow ground_;
    std::optional<SceneNames> names_;  // set if ids were requested
};

}  // namespace bdpt
