#pragma once

#include <bdpt/types.h>
#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "options/groups/view_arguments.h"

namespace bdpt::job {

[[nodiscard]] inline double degrees(float radians)
{
    return static_cast<double>(radians) * 180.0 / std::numbers::pi;
}

/// Formats "1,2,3" with four digits each.
[[nodiscard]] inline std::string to_text(Vec3 v)
{
    return fmt::format("{:.4g},{:.4g},{:.4g}", v.x, v.y, v.z);
}

[[nodiscard]] inline nlohmann::ordered_json to_json(Vec3 v)
{
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

// Points of the world in the coordinates of the file, where `origin` is that of the world
// (`SceneDesc::origin`).

[[nodiscard]] inline std::string to_text(Vec3 point, const DVec3& origin)
{
    return place_text(point, origin, 4);
}

[[nodiscard]] inline nlohmann::ordered_json to_json(Vec3 point, const DVec3& origin)
{
    const DVec3 place = to_file(point, origin);
    return nlohmann::ordered_json::array({place.x, place.y, place.z});
}

/// Returns the value, or null if there is none.
template <typename Value>
[[nodiscard]] nlohmann::ordered_json or_null(const std::optional<Value>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// Adds the projection of `camera`, and its lens if it has one, to the object `json`.
inline void add_projection(nlohmann::ordered_json& json, const CameraDesc& camera)
{
    if (camera.projection == Projection::orthographic) {
        json["projection"] = "orthographic";
        json["vertical_extent"] = camera.vertical_extent;
    } else {
        json["projection"] = "perspective";
        json["vertical_fov_degrees"] = degrees(camera.vertical_fov);
    }
    if (camera.shift != Vec2(0.0f)) {
        json["shift"] = {camera.shift.x, camera.shift.y};
    }
    if (camera.pixel_aspect != 1.0f) {
        json["pixel_aspect"] = camera.pixel_aspect;
    }
    if (camera.lens_radius > 0.0f) {
        json["lens_radius"] = camera.lens_radius;
        json["focus_distance"] = camera.focus_distance;
    }
}

/// Returns the names of `files` as an array.
[[nodiscard]] inline nlohmann::ordered_json names_json(
    const std::vector<std::filesystem::path>& files)
{
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const std::filesystem::path& file : files) {
        names.push_back(file.string());
    }
    return names;
}

}  // namespace bdpt::job
