#pragma once

#include "camera/camera.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <vector>

namespace bdpt {

/// A camera while the shutter is open.
class MovingCamera {
public:
    /// Constructs a static camera.
    explicit MovingCamera(const Camera& camera) : first_(camera) {}
    /// `camera` is `desc` on its film; moves as `desc` does.
    MovingCamera(const CameraDesc& desc, const Camera& camera)
        : first_(camera), pose_(desc.world_from_camera), motion_(desc.motion)
    {}

    [[nodiscard]] bool moves() const { return !motion_.empty(); }
    /// Returns the camera at shutter open.
    [[nodiscard]] const Camera& first() const { return first_; }
    /// Returns the camera at a time in [0, 1]: its matrix is interpolated linearly between steps,
    /// its axes stay orthonormal.
    [[nodiscard]] Camera at(float time) const;

private:
    Camera first_;
    Mat4 pose_{1.0f};  ///< at shutter open
    std::vector<Mat4> motion_;
};

/// A moving camera at one time; a static camera is not copied, and must outlive this.
class TimedCamera {
public:
    TimedCamera(const MovingCamera& camera, float time)
        : moved_(camera.moves() ? std::optional(camera.at(time)) : std::nullopt),
          camera_(moved_ ? *moved_ : camera.first())
    {}
    TimedCamera(const TimedCamera&) = delete;
    TimedCamera& operator=(const TimedCamera&) = delete;

    [[nodiscard]] const Camera& get() const { return camera_; }

private:
    std::optional<Camera> moved_;
    const Camera& camera_;
};

}  // namespace bdpt
