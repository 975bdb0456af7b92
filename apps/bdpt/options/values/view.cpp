#include "options/values/view.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terminal/text.h"

namespace bdpt::app {
namespace {

std::string list_cameras(std::span<const CameraDesc> cameras)
{
    constexpr std::size_t max_listed = 8;
    std::string result;
    for (std::size_t i = 0; i < std::min(cameras.size(), max_listed); ++i) {
        const std::string& name = cameras[i].name;
        result += fmt::format("{}{}{}", i == 0 ? "" : ", ", i,
                              name.empty() ? "" : fmt::format(" \"{}\"", name));
    }
    return result + (cameras.size() > max_listed ? ", ..." : "");
}

/// Returns camera axes that look from `eye` to `target`, upright where that is defined.
Mat4 look_at(Vec3 eye, Vec3 target)
{
    // Closer to the vertical, +y is no longer up in the image; then -z is.
    constexpr float vertical = 0.9999f;
    const Vec3 forward = glm::normalize(target - eye);
    const Vec3 up =
        std::abs(forward.y) < vertical ? Vec3(0.0f, 1.0f, 0.0f) : Vec3(0.0f, 0.0f, -1.0f);
    const Vec3 right = glm::normalize(glm::cross(forward, up));
    return Mat4(Vec4(right, 0.0f), Vec4(glm::cross(right, forward), 0.0f), Vec4(-forward, 0.0f),
                Vec4(eye, 1.0f));
}

}  // namespace

const CameraDesc& select_camera(std::span<const CameraDesc> cameras,
                                const std::string& name_or_index, const std::string& file)
{
    const auto named = std::find_if(cameras.begin(), cameras.end(), [&](const CameraDesc& camera) {
        return camera.name == name_or_index;
    });
    if (named != cameras.end()) {
        return *named;
    }
    const std::optional<std::size_t> index = parse_index(name_or_index);
    if (index && *index < cameras.size()) {
        return cameras[*index];
    }
    const std::string what = fmt::format("{}: no camera \"{}\"", file, name_or_index);
    throw Error(
        ErrorCode::not_found,
        cameras.empty()
            ? fmt::format("{}; the scene has none (--camera auto frames it)", what)
            : fmt::format("{}; this scene has {}: {}", what,
                          cameras.size() == 1 ? "one camera" : counted(cameras.size(), "camera"),
                          list_cameras(cameras)));
}

std::string place_text(Vec3 point, const DVec3& origin, int digits)
{
    constexpr int many = 9;
    const DVec3 place = to_file(point, origin);
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        text += fmt::format("{}{:.{}g}", axis == 0 ? "" : ",", place[axis],
                            origin[axis] == 0.0 ? digits : many);
    }
    return text;
}

CameraDesc apply(const ViewOverrides& overrides, const CameraDesc& camera,
                 const std::optional<Vec3>& target, const DVec3& origin)
{
    if (overrides.vertical_fov && camera.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} is orthographic: --fov needs a perspective camera",
                                camera.name));
    }
    CameraDesc result = camera;
    result.vertical_fov = overrides.vertical_fov.value_or(camera.vertical_fov);
    if (!overrides.from && !overrides.look_at) {
        return result;
    }
    result.motion.clear();  // The user fixes the position.
    const Vec3 eye =
        overrides.from ? to_world(*overrides.from, origin) : Vec3(camera.world_from_camera[3]);
    const std::optional<Vec3> goal =
        overrides.look_at ? to_world(*overrides.look_at, origin) : target;
    if (!goal) {
        result.world_from_camera[3] = Vec4(eye, 1.0f);
        return result;
    }
    const Vec3 forward = *goal - eye;
    if (!(glm::dot(forward, forward) > 0.0f)) {
        const Vec3 place(to_file(eye, origin));
        throw Error(ErrorCode::usage,
                    fmt::format("the camera at {},{},{} cannot look at its own position: --from "
                                "and --look-at must differ",
                                place.x, place.y, place.z));
    }
    result.world_from_camera = look_at(eye, *goal);
    return result;
}

Size default_size(const std::optional<float>& aspect_ratio)
{
    constexpr Size box{1280, 720};
    constexpr float box_aspect = 1280.0f / 720.0f;
    const float aspect = aspect_ratio.value_or(box_aspect);
    if (!(aspect > 0.0f) || !std::isfinite(aspect)) {
        return box;
    }
    // Clamped before the conversion, as a ratio of 1e30 exceeds an int.
    if (aspect >= box_aspect) {
        const float height = std::max(1.0f, std::round(static_cast<float>(box.width) / aspect));
        return {box.width, static_cast<int>(height)};
    }
    const float width = std::max(1.0f, std::round(static_cast<float>(box.height) * aspect));
    return {static_cast<int>(width), box.height};
}

}  // namespace bdpt::app
