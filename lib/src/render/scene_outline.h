#pragma once

#include "camera/camera.h"

#include <bdpt/scene.h>

#include <optional>

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

}  // namespace bdpt
