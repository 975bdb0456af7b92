#include "render/scene_outline.h"

#include <glm/common.hpp>

#include <limits>

namespace bdpt {

SceneOutline::SceneOutline(const MovingCamera& camera, const Bounds& bounds)
{
    if (camera.moves() || camera.first().has_finite_lens()) {
        return;
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RasterBounds outline{.min = Vec2(infinity), .max = Vec2(-infinity)};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sides((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        const auto raster =
            camera.first().project(bounds.min + sides * (bounds.max - bounds.min));
        if (!raster) {
            return;
        }
        outline.min = min(outline.min, *raster);
        outline.max = max(outline.max, *raster);
    }
    constexpr float rounding = 0.25f;  // [pixels], much more than projections and rays round
    outline_ = {.min = outline.min - rounding, .max = outline.max + rounding};
}

bool SceneOutline::is_beside(const RasterBounds& area) const noexcept
{
    return outline_ && (area.max.x < outline_->min.x || area.min.x > outline_->max.x ||
                        area.max.y < outline_->min.y || area.min.y > outline_->max.y);
}

}  // namespace bdpt
