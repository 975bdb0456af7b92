#pragma once

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "scene/world.h"

#include <bdpt/render_options.h>

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

}  // namespace bdpt
