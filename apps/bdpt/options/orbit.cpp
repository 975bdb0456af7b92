#include "options/orbit.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

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
                    fmt::format("camera {} looks away from the middle of the scene: --orbit needs "
                                "--look-at, the point to go around",
                                camera.name));
    }
    return eye + distance * forward;
}

CameraDesc orbited(CameraDesc camera, Vec3 center, double angle)
{
    if (angle == 0.0) {
        return camera;
    }
    const glm::dvec3 c(center);
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    glm::dmat4 turn(1.0);
    turn[0] = {cosine, 0.0, -sine, 0.0};
    turn[2] = {sine, 0.0, cosine, 0.0};
    turn[3] = glm::dvec4(c - glm::dvec3(turn * glm::dvec4(c, 0.0)), 1.0);
    camera.world_from_camera = Mat4(turn * glm::dmat4(camera.world_from_camera));
    for (Mat4& pose : camera.motion) {
        pose = Mat4(turn * glm::dmat4(pose));
    }
    return camera;
}

}  // namespace bdpt::app
