#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <optional>

#include "options/arguments.h"

namespace bdpt::app {

/// Where a camera stands, and what it looks at [m].
struct Pose {
    Vec3 from{0.0f};
    Vec3 look_at{0.0f};
    [[nodiscard]] bool operator==(const Pose&) const = default;
};

/// How a hand moves what it sees.
struct Move {
    Vec2 orbit{0.0f};    ///< [rad] the scene turns to the right and down about `look_at`
    Vec2 pan{0.0f};      ///< [heights of the image] the scene goes to the right and down
    float dolly = 1.0f;  ///< factor of the distance
    /// Both, one after the other.
    Move& operator+=(const Move& next);
};

/// The pose after `move`. `height` is what the image shows of a plane at distance 1 [m].
[[nodiscard]] Pose moved(const Pose& pose, const Move& move, float height);

/// What the image of `camera` shows of a plane at distance 1, for a perspective one; for an
/// orthographic one what it shows of any, over the distance `distance` [m].
[[nodiscard]] float view_height(const CameraDesc& camera, float distance);

/// Where the camera stands, and the point at `distance` that it looks at.
[[nodiscard]] Pose pose_of(const CameraDesc& camera, float distance);

/// Where `point` is in the image of `camera` [pixels]; none: it is not before the camera.
[[nodiscard]] std::optional<Vec2> raster_of(const CameraDesc& camera, const Size& size, Vec3 point);

/// Where the unit direction `direction` is, of what is infinitely far away.
[[nodiscard]] std::optional<Vec2> raster_of_direction(const CameraDesc& camera, const Size& size,
                                                      Vec3 direction);

}  // namespace bdpt::app
