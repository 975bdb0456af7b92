#pragma once

#include "film/pixel_filter.h"
#include "integrator/integrator.h"
#include "render/ground/ground_shadow.h"
#include "scene/scene_names.h"

#include <bdpt/film/aov_film.h>
#include <bdpt/film/id_film.h>

#include <optional>
#include <vector>

namespace bdpt {

/// Follows the camera rays of a render once more, at their own times, to the first surface or to
/// the ground only: the same for every integrator.
class AovPass {
public:
    /// The world and the camera must outlive this.
    AovPass(const World& world, const MovingCamera& camera, const RenderOptions& options);
    /// Adds the samples of the pixels of `tile` that are in the films' region. Returns the work
    /// that it was.
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples, AovFilm& film,
                                          IdFilm& ids) const;
    /// Of what may be met, if ids were asked for.
    [[nodiscard]] IdNames names() const;

private:
    /// `met` gets the ids of the surface that the ray meets, if ids were asked for.
    void add_sample(int x, int y, std::int64_t sample_index, AovFilm& film,
                    std::vector<SurfaceIds>& met, RayCounts& rays) const;

    /// What surfaces take away of the light along a camera ray, in [0, 1].
    [[nodiscard]] float opacity_along(const CameraRay& ray, SegmentKey segment,
                                      RayCounts& rays) const;

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
    bool needs_surfaces_;
    GroundShadow ground_;
    std::optional<SceneNames> names_;  // if ids were asked for
};

}  // namespace bdpt
