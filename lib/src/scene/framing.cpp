#include <bdpt/framing.h>

#include "math/elementary.h"
#include "scene/surroundings.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bdpt {
namespace {

constexpr float outside_fov = 0.6981317f;        // 40 degrees: little perspective for objects
constexpr float inside_fov = 1.0471976f;         // 60 degrees: rooms are small
constexpr float outside_azimuth = 0.6108652f;    // 35 degrees from +z, the front of glTF, to +x
constexpr float outside_elevation = 0.3490659f;  // 20 degrees

/// Thresholds that tell rooms from objects, found by trying both kinds.
constexpr float room_front = 0.6f;   // share of directions in which a room shows a front face
constexpr float room_shell = 0.35f;  // ... that lies near the bounds: walls, not neighbours
constexpr float open_side = 0.5f;    // how much the free directions agree: an open side
constexpr float open_share = 0.08f;  // ... and how many there are at least
constexpr float enclosed_escape = 0.02f;

CameraDesc look_at(Vec3 from, Vec3 to, float vertical_fov)
{
    const Vec3 back = normalize(from - to);
    const Vec3 up = std::abs(back.y) > 0.999f ? Vec3(0.0f, 0.0f, -1.0f) : Vec3(0.0f, 1.0f, 0.0f);
    const Vec3 right = normalize(cross(up, back));
    CameraDesc camera;
    camera.name = "auto";
    camera.world_from_camera =
        Mat4(Vec4(right, 0.0f), Vec4(cross(back, right), 0.0f), Vec4(back, 0.0f), Vec4(from, 1.0f));
    camera.vertical_fov = vertical_fov;
    return camera;
}

/// Looks at the bounds along -`towards_eye` from as near as shows all of them.
CameraDesc frame_from_outside(const Bounds& bounds, Vec3 towards_eye, float aspect)
{
    const Vec3 center = 0.5f * (bounds.min + bounds.max);
    const Mat4 axes = look_at(center + towards_eye, center, outside_fov).world_from_camera;
    const SinCos half = sin_cos(0.5f * outside_fov);
    constexpr float margin = 1.08f;
    const float slope_y = half.sin / half.cos / margin;
    const float slope_x = slope_y * aspect;
    float distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                     (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                     (corner & 4) != 0 ? bounds.max.z : bounds.min.z);
        const Vec3 local(dot(p - center, Vec3(axes[0])), dot(p - center, Vec3(axes[1])),
                         dot(p - center, Vec3(axes[2])));
        const float needed =
            local.z + std::max(std::abs(local.x) / slope_x, std::abs(local.y) / slope_y);
        distance = std::max(distance, needed);
    }
    const float size = glm::length(bounds.max - bounds.min);
    return look_at(center + std::max(distance, 0.01f * size) * towards_eye, center, outside_fov);
}

/// Points of a grid in the bounds, with what is seen from each.
std::vector<Surroundings> survey(const World& world)
{
    constexpr int steps = 5;
    const Bounds& bounds = world.bounds();
    std::vector<Surroundings> places;
    for (int i = 0; i < steps * steps * steps; ++i) {
        const Vec3 cell(i % steps, i / steps % steps, i / (steps * steps));
        const Vec3 fraction = 0.1f + 0.8f * cell / static_cast<float>(steps - 1);
        places.push_back(look_around(world, mix(bounds.min, bounds.max, fraction)));
    }
    return places;
}

bool is_in_room(const Surroundings& place)
{
    return place.front >= room_front && place.shell >= room_shell;
}

/// The view among the places of a room that sees farthest without anything right before the lens.
CameraDesc frame_from_inside(const World& world, const std::vector<Surroundings>& room,
                             float aspect)
{
    constexpr int azimuths = 16;
    constexpr float pitch = -0.12f;  // slightly downwards
    const Bounds& bounds = world.bounds();
    const float eye_height = bounds.min.y + 0.55f * (bounds.max.y - bounds.min.y);
    const float height = std::max(bounds.max.y - bounds.min.y, 1e-6f);
    CameraDesc best = look_at(room.front().p, room.front().p + Vec3(0.0f, 0.0f, -1.0f), inside_fov);
    float best_score = -1.0f;
    for (const Surroundings& place : room) {
        for (int i = 0; i < azimuths; ++i) {
            const SinCos azimuth = sin_cos(2.0f * pi * static_cast<float>(i) / azimuths);
            const SinCos tilt = sin_cos(pitch);
            const Vec3 forward(tilt.cos * azimuth.sin, tilt.sin, -tilt.cos * azimuth.cos);
            const CameraDesc camera = look_at(place.p, place.p + forward, inside_fov);
            const float off_height = std::abs(place.p.y - eye_height) / height;
            const float score = view_depth(world, camera, aspect) * (1.0f - 0.5f * off_height);
            if (score > best_score) {
                best_score = score;
                best = camera;
            }
        }
    }
    return best;
}

/// The highest place of a room, near its middle, that does not touch anything.
Vec3 lamp_in(const World& world, const std::vector<Surroundings>& room)
{
    const Bounds& bounds = world.bounds();
    const Vec3 center = 0.5f * (bounds.min + bounds.max);
    const float size = glm::length(bounds.max - bounds.min);
    Vec3 best = center;
    float best_score = -std::numeric_limits<float>::infinity();
    for (const Surroundings& place : room) {
        const Vec3 offset = place.p - center;
        const float aside = std::sqrt(offset.x * offset.x + offset.z * offset.z);
        const float crowded = place.clearance < 0.02f * size ? size : 0.0f;
        const float score = offset.y - aside - crowded;
        if (score > best_score) {
            best_score = score;
            best = place.p;
        }
    }
    return best;
}

}  // namespace

FramedView frame_scene(const Scene& scene, float aspect)
{
    const World& world = scene.world();
    const Bounds& bounds = world.bounds();
    FramedView view;
    const SinCos azimuth = sin_cos(outside_azimuth);
    const SinCos elevation = sin_cos(outside_elevation);
    const Vec3 three_quarters(elevation.cos * azimuth.sin, elevation.sin,
                              elevation.cos * azimuth.cos);
    view.camera = frame_from_outside(bounds, three_quarters, aspect);
    view.lamp_position = Vec3(view.camera.world_from_camera[3]);

    std::vector<Surroundings> room = survey(world);
    std::erase_if(room, [](const Surroundings& place) { return !is_in_room(place); });
    if (room.empty()) {
        return view;
    }
    view.lamp_position = lamp_in(world, room);

    float escaped = 0.0f;  // mean over the room
    Vec3 opening(0.0f);    // mean of the free directions
    for (const Surroundings& place : room) {
        escaped += place.escaped / static_cast<float>(room.size());
        opening += place.escape_direction * (place.escaped / static_cast<float>(room.size()));
    }
    opening /= std::max(escaped, 1e-6f);
    const bool open_at_a_side = escaped >= open_share && glm::length(opening) >= open_side &&
                                std::abs(opening.y) < 0.5f * glm::length(opening);
    if (open_at_a_side) {
        // A box without its front wall: look in from there, straight if it is nearly straight.
        Vec3 towards_eye = normalize(Vec3(opening.x, 0.0f, opening.z));
        if (std::max(std::abs(towards_eye.x), std::abs(towards_eye.z)) > 0.9f) {
            towards_eye = glm::round(towards_eye);
        }
        view.camera = frame_from_outside(bounds, towards_eye, aspect);
        return view;
    }
    view.camera = frame_from_inside(world, room, aspect);
    view.enclosed =
        look_around(world, Vec3(view.camera.world_from_camera[3])).escaped < enclosed_escape;
    return view;
}

}  // namespace bdpt
