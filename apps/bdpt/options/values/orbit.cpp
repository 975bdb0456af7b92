#include "options/values/orbit.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <glm/geometric.hpp>

namespace bdpt::app {

Vec3 orbit_center(const CameraDesc& camera, const std::optional<Vec3>& look_at, Vec3 middle)
{
    if (look_at) {
        return *look_at;
    }
    const Vec3 eye(camera.world_from_camera[3]);
    const Vec3 forward = -glm::normalize(Vec3(camera.world_from_camera[2]));
    const float distance = glm::dot(middle - eye, forward);
    if (!(distance > 0.0f)) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} looks away from the centre of the scene: --orbit needs "
                                "--look-at, the point to orbit",
                                camera.name));
    }
    return eye + distance * forward;
}

}  // namespace bdpt::app
