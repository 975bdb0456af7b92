#pragma once

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "light/learned/learned_light.h"
#include "scene/world.h"

#include <bdpt/part/identity.h>
#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <memory>
#include <stop_token>
#include <vector>

namespace bdpt {

[[nodiscard]] inline PixelRect whole_image(const RenderOptions& options)
{
    return {.x0 = 0, .y0 = 0, .x1 = options.film.width, .y1 = options.film.height};
}

/// Returns the camera on the film of `options`, which has been checked.
[[nodiscard]] inline MovingCamera open_camera(const World& world, const CameraDesc& desc,
                                              const RenderOptions& options)
{
    const PixelRect region = options.film.crop.value_or(whole_image(options));
    // Positions that contribute to a pixel of the region can lie beside it, even beside the image.
    const float margin = PixelFilter(options.film.filter).radius() - 0.5f;
    return {desc, Camera(desc, options.film.width, options.film.height,
                         {.min = Vec2(region.x0, region.y0) - margin,
                          .max = Vec2(region.x1, region.y1) + margin},
                         world.medium_at(Vec3(desc.world_from_camera[3])))};
}

/// Returns the result of `learn_light` for the whole image of this camera, using the threads that
/// the options allow. `options` have been checked, and name an integrator. The world remembers the
/// result, so that all renders of the same view learn once; null, and not remembered, once
/// `abandon` is requested.
[[nodiscard]] std::shared_ptr<const LearnedLight> learned_light(
    const World& world, const CameraDesc& camera, const RenderOptions& options,
    const std::stop_token& abandon = {});

/// Adds what bits depend on: all of a camera but its name.
void add_camera(std::vector<IdentityComponent>& result, const CameraDesc& camera);

/// Adds all options that change bits of samples.
void add_options(std::vector<IdentityComponent>& result, const RenderOptions& options);

}  // namespace bdpt
