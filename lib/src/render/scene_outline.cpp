#include "render/scene_outline.h"

#include "math/frame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace bdpt {

SceneOutline::SceneOutline(const MovingCamera& camera, const Bounds& bounds)
{
    if (camera.moves() || camera.first().has_finite_lens()) {
        return;
    }
    const PixelCone& cone = camera.first().pixel_cone();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RasterBounds outline{.min = Vec2(infinity), .max = Vec2(-infinity)};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sides((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        const Vec3 p = bounds.min + sides * (bounds.max - bounds.min);
        const auto raster = camera.first().project(p);
        if (!raster || !std::isfinite(raster->x + raster->y)) {
            return;
        }
        // Rounding errors of rays and projections [pixels]: small but for telephoto lenses, and
        // where the film is seen at a slant.
        const float way = glm::length(p - cone.eye);
        const float reach = glm::length(cone.eye) + way;
        const float slant = camera.first().is_perspective() ? way / camera.first().depth(p) : 1.0f;
        const float rounding = 0.25f + 0x1p-20f * slant * slant * reach / cone.width_at(p);
        outline.min = min(outline.min, *raster - rounding);
        outline.max = max(outline.max, *raster + rounding);
    }
    outline_ = outline;
}

bool SceneOutline::is_beside(const RasterBounds& area) const noexcept
{
    return outline_ && (area.max.x < outline_->min.x || area.min.x > outline_->max.x ||
                        area.max.y < outline_->min.y || area.min.y > outline_->max.y);
}

}  // namespace bdpt
