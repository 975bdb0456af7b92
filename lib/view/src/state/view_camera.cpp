#include "state/view_state.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "options/groups/transport_arguments.h"
#include "output/render_report.h"

namespace bdpt::view {

namespace {

/// Right, up and forward unit vectors.
struct Axes {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
};

Axes compute_axes(const CameraDesc& camera)
{
    return {.right = glm::normalize(Vec3(camera.world_from_camera[0])),
            .up = glm::normalize(Vec3(camera.world_from_camera[1])),
            .forward = -glm::normalize(Vec3(camera.world_from_camera[2]))};
}

/// Returns the position in the image of a point at an offset from the camera.
std::optional<Vec2> project_offset(const CameraDesc& camera, const Size& size, Vec3 offset)
{
    const Axes axes = compute_axes(camera);
    const float depth = glm::dot(offset, axes.forward);
    if (!(depth > 0.0f)) {
        return std::nullopt;
    }
    const float height = view_height(camera, depth) * depth;  // height of the image at that depth
    const auto pixels = static_cast<float>(size.height);
    const Vec2 place =
        Vec2(glm::dot(offset, axes.right) / camera.pixel_aspect, -glm::dot(offset, axes.up)) /
        height;
    const Vec2 axis(0.5f - camera.shift.x, 0.5f + camera.shift.y);
    const Vec2 raster = pixels * place + axis * Vec2(static_cast<float>(size.width), pixels);
    return std::isfinite(raster.x) && std::isfinite(raster.y) ? std::optional(raster)
                                                              : std::nullopt;
}

}  // namespace

Move& Move::operator+=(const Move& next)
{
    orbit += next.orbit;
    pan += next.pan;
    dolly *= next.dolly;
    return *this;
}

Pose moved(const Pose& pose, const Move& move, float height)
{
    // Upright: a camera that looks along the vertical has no right axis.
    constexpr float steepest = 0.499f * std::numbers::pi_v<float>;
    const Vec3 arm = pose.from - pose.look_at;
    const float distance = glm::length(arm);
    if (!(distance > 0.0f)) {
        return pose;
    }
    const float azimuth = std::atan2(arm.x, arm.z) - move.orbit.x;
    const float elevation = std::clamp(
        std::asin(std::clamp(arm.y / distance, -1.0f, 1.0f)) + move.orbit.y, -steepest, steepest);
    const Vec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                         std::cos(elevation) * std::cos(azimuth));
    const Vec3 right(std::cos(azimuth), 0.0f, -std::sin(azimuth));
    const Vec3 up = glm::cross(direction, right);
    const Vec3 shift = distance * height * (move.pan.y * up - move.pan.x * right);
    // At smaller distances floats cannot tell the two points apart.
    const float nearest = 1e-4f * std::max(distance, 1e-3f);
    const Vec3 look_at = pose.look_at + shift;
    const Pose result{.from = look_at + std::max(distance * move.dolly, nearest) * direction,
                      .look_at = look_at};
    const auto is_finite = [](Vec3 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return is_finite(result.from) && is_finite(result.look_at) && result.from != result.look_at
               ? result
               : pose;
}

float view_height(const CameraDesc& camera, float distance)
{
    return camera.projection == Projection::orthographic
               ? camera.vertical_extent / distance
               : 2.0f * std::tan(0.5f * camera.vertical_fov);
}

Pose compute_pose(const CameraDesc& camera, float distance)
{
    const Vec3 from(camera.world_from_camera[3]);
    return {.from = from, .look_at = from + distance * compute_axes(camera).forward};
}

std::optional<Vec2> project_point(const CameraDesc& camera, const Size& size, Vec3 point)
{
    return project_offset(camera, size, point - Vec3(camera.world_from_camera[3]));
}

std::optional<Vec2> project_direction(const CameraDesc& camera, const Size& size, Vec3 direction)
{
    return camera.projection == Projection::orthographic ? std::nullopt
                                                         : project_offset(camera, size, direction);
}

namespace {

using nlohmann::ordered_json;

void add_places(ordered_json& vertices, const std::vector<InspectedVertex>& path,
                const PreparedScene& stage)
{
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool is_infinite = path[i].kind == InspectedKind::infinite;
        const std::optional<Vec2> place =
            is_infinite ? project_direction(stage.camera, stage.size, path[i].position)
                        : project_point(stage.camera, stage.size, path[i].position);
        vertices[i]["raster"] = place ? ordered_json::array({place->x, place->y}) : ordered_json();
    }
}

}  // namespace

std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                           const PixelSample& pixel)
{
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    const InspectedSample sample = inspect_sample(stage.scene, stage.camera, options, pixel);
    ordered_json json = inspect_json(sample, pixel, stage.scene.description().origin);
    add_places(json["camera_path"], sample.camera_path, stage);
    add_places(json["light_path"], sample.light_path, stage);
    json["settings"] = transport_json(options);
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace bdpt::view
