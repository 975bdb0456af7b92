#include <bdpt/tools/intrinsics.h>

#include "math/elementary.h"

namespace bdpt {

Intrinsics intrinsics(const CameraDesc& camera, int width, int height)
{
    const double fy = focal_length(static_cast<double>(camera.vertical_fov), height);
    return {.fx = fy / static_cast<double>(camera.pixel_aspect),
            .fy = fy,
            .cx = width * (0.5 - static_cast<double>(camera.shift.x)),
            .cy = height * (0.5 + static_cast<double>(camera.shift.y))};
}

void set_intrinsics(CameraDesc& camera, const Intrinsics& values, int width, int height)
{
    camera.vertical_fov = static_cast<float>(angle_of_view(values.fy, height));
    camera.pixel_aspect = static_cast<float>(values.fy / values.fx);
    camera.shift = Vec2(0.5 - values.cx / width, values.cy / height - 0.5);
}

double focal_length(double angle, int extent)
{
    const SinCos half = sin_cos(0.5f * static_cast<float>(angle));
    return 0.5 * extent * static_cast<double>(half.cos) / static_cast<double>(half.sin);
}

double angle_of_view(double focal_length, int extent)
{
    return 2.0 *
           static_cast<double>(atan2_exact(static_cast<float>(0.5 * extent / focal_length), 1.0f));
}

}  // namespace bdpt
