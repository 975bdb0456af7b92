#pragma once

#include <bdpt/inspect.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <optional>
#include <string>

#include "stage/prepared_scene.h"
#include "state/view_words.h"

namespace bdpt::view {

/// Position of a camera, and its target [m], in the world.
struct Pose {
    Vec3 from{0.0f};
    Vec3 look_at{0.0f};
    [[nodiscard]] bool operator==(const Pose&) const = default;
};

/// Motion of the camera by the user's hand.
struct Move {
    Vec2 orbit{0.0f};    ///< [rad]; the scene turns to the right and down about `look_at`
    Vec2 pan{0.0f};      ///< [heights of the image]; the scene moves to the right and down
    float dolly = 1.0f;  ///< factor of the distance
    /// Appends the next motion.
    Move& operator+=(const Move& next);
};

/// Returns the pose after `move`. `height` is the visible height of a plane at distance 1 [m].
[[nodiscard]] Pose moved(const Pose& pose, const Move& move, float height);

/// Returns the visible height of a plane at distance 1 for a perspective camera; for an
/// orthographic one the visible height of any plane over `distance` [m].
[[nodiscard]] float view_height(const CameraDesc& camera, float distance);

/// Returns the position of the camera, and its target at `distance`.
[[nodiscard]] Pose compute_pose(const CameraDesc& camera, float distance);

/// Returns the position of `point` in the image of `camera` [pixels]; none: it is not in front of
/// the camera.
[[nodiscard]] std::optional<Vec2> project_point(const CameraDesc& camera, const Size& size,
                                                Vec3 point);

/// Returns the position in the image of points infinitely far away in the unit direction
/// `direction`.
[[nodiscard]] std::optional<Vec2> project_direction(const CameraDesc& camera, const Size& size,
                                                    Vec3 direction);

/// Returns the output of `bdpt inspect --json` for the sample, as one line, with the positions of
/// its vertices in the image: "raster", [x, y] or null. Throws as inspect_sample() does.
[[nodiscard]] std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                                         const PixelSample& pixel);

}  // namespace bdpt::view
