#include <bdpt/framing.h>

#include "math/elementary.h"
#include "scene/framing/frame_fit.h"
#include "scene/framing/visibility_probe.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

constexpr float outside_fov = 0.6981317f;  // 40 degrees: little perspective for objects
constexpr float inside_fov = 1.0471976f;   // 60 degrees: rooms are small
constexpr float object_margin = 0.1f;
constexpr float box_margin = 0.037f;  // for rooms without a wall: their frame is no object

// Thresholds that distinguish rooms from objects, tuned on scenes of both kinds.
constexpr float closed_front = 0.93f;   // fraction of directions in which a closed room shows a
                                        // front
constexpr float closed_shell = 0.3f;    // fraction whose front lies near the bounds: walls, not
                                        // neighbours
constexpr float closed_escape = 0.03f;  // maximum fraction that leaves, through windows
constexpr int closed_places = 3;        // minimum number of such places of the survey in a closed
                                        // room
constexpr float box_front = 0.65f;      // corresponding thresholds for a room that lacks one wall
constexpr float box_shell = 0.5f;
constexpr float box_escape = 0.1f;  // minimum mean fraction that leaves: more than through windows
constexpr int box_places = 30;
constexpr float box_agreement = 0.5f;  // minimum agreement of the free directions on the missing
                                       // wall
constexpr float enclosed_escape = 0.02f;

// Thresholds that distinguish flat and long objects from others, tuned on models of both kinds.
constexpr float board_depth = 0.26f;  // relative to the smaller of the other two extents: labels,
                                      // reliefs
constexpr float plate_height = 0.1f;  // likewise: floors, terrains
constexpr float row_length = 4.0f;    // relative to the larger of the other two extents

constexpr ViewDirection board_view{.azimuth = 0.2617994f,
                                   .elevation = 0.1396263f};  // 15, 8 degrees
constexpr float quarter_turn = 1.5707964f;
constexpr float plate_elevation = 0.7853982f;  // 45 degrees

/// Returns the viewing direction for an object, given the extents of its bounds: a board is viewed
/// nearly from its front, as its content cannot be seen at a slant; a plate from higher above; a
/// row from its long side.
ViewDirection direction_for(Vec3 extent)
{
    const float aside = quarter_turn - board_view.azimuth;
    if (extent.z < board_depth * std::min(extent.x, extent.y)) {
        return board_view;
    }
    if (extent.x < board_depth * std::min(extent.y, extent.z)) {
        return {.azimuth = aside, .elevation = board_view.elevation};
    }
    ViewDirection view = three_quarter_view;
    if (extent.x > row_length * std::max(extent.y, extent.z)) {
        view.azimuth = board_view.azimuth;
    } else if (extent.z > row_length * std::max(extent.x, extent.y)) {
        view.azimuth = aside;
    }
    if (extent.y < plate_height * std::min(extent.x, extent.z)) {
        view.elevation = plate_elevation;
    }
    return view;
}

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

/// Returns the axes (right, up, back) of an upright camera in that direction.
Mat3 axes_towards(const ViewDirection& direction)
{
    const SinCos azimuth = sin_cos(direction.azimuth);
    const SinCos elevation = sin_cos(direction.elevation);
    const Vec3 right(azimuth.cos, 0.0f, -azimuth.sin);
    const Vec3 back(elevation.cos * azimuth.sin, elevation.sin, elevation.cos * azimuth.cos);
    return Mat3(right, cross(back, right), back);
}

/// Frames the scene from outside along the negative last column of `axes`.
CameraDesc frame_from_outside(const World& world, const Mat3& axes, float aspect, float margin,
                              const FrameOptions& options)
{
    CameraDesc camera;
    camera.name = "auto";
    camera.projection = options.projection;
    camera.vertical_fov = options.vertical_fov.value_or(outside_fov);
    return fitted_camera(world.geometry(), axes,
                         {.aspect = aspect,
                          .margin = options.margin.value_or(margin),
                          .camera = std::move(camera),
                          .whole_turn = options.whole_turn});
}

/// Probes the visibility from points of a grid in the bounds.
std::vector<VisibilityProbe> survey(const World& world)
{
    constexpr int steps = 5;
    const Bounds& bounds = world.bounds();
    std::vector<VisibilityProbe> places;
    for (int i = 0; i < steps * steps * steps; ++i) {
        const Vec3 cell(i % steps, i / steps % steps, i / (steps * steps));
        const Vec3 fraction = 0.1f + 0.8f * cell / static_cast<float>(steps - 1);
        places.push_back(probe_visibility(world, mix(bounds.min, bounds.max, fraction)));
    }
    return places;
}

std::vector<VisibilityProbe> places_with(const std::vector<VisibilityProbe>& places, float front,
                                         float shell, float escape)
{
    std::vector<VisibilityProbe> result;
    std::copy_if(places.begin(), places.end(), std::back_inserter(result),
                 [&](const VisibilityProbe& p) {
                     return p.front >= front && p.shell >= shell && p.escaped <= escape;
                 });
    return result;
}

/// Returns the horizontal direction in which a room lacks a wall, aligned to an axis if nearly so.
std::optional<Vec3> missing_wall(const std::vector<VisibilityProbe>& room)
{
    Vec3 opening(0.0f);
    float escaped = 0.0f;
    for (const VisibilityProbe& place : room) {
        escaped += place.escaped;
        opening += place.escaped * place.escape_direction;
    }
    if (escaped < box_escape * static_cast<float>(room.size())) {
        return std::nullopt;
    }
    opening /= escaped;
    const float agreement = glm::length(opening);
    if (agreement < box_agreement || std::abs(opening.y) > 0.5f * agreement) {
        return std::nullopt;
    }
    const Vec3 level = normalize(Vec3(opening.x, 0.0f, opening.z));
    return std::max(std::abs(level.x), std::abs(level.z)) > 0.9f ? glm::round(level) : level;
}

/// Returns the view from a place of a room that sees farthest with nothing right in front of the
/// lens.
CameraDesc frame_from_inside(const World& world, const std::vector<VisibilityProbe>& room,
                             float aspect, float fov)
{
    constexpr int azimuths = 16;
    constexpr float pitch = -0.12f;  // slightly downwards
    const Bounds& bounds = world.bounds();
    const float eye_height = bounds.min.y + 0.55f * (bounds.max.y - bounds.min.y);
    const float height = std::max(bounds.max.y - bounds.min.y, 1e-6f);
    CameraDesc best = look_at(room.front().p, room.front().p + Vec3(0.0f, 0.0f, -1.0f), fov);
    float best_score = -1.0f;
    for (const VisibilityProbe& place : room) {
        for (int i = 0; i < azimuths; ++i) {
            const SinCos azimuth = sin_cos(2.0f * pi * static_cast<float>(i) / azimuths);
            const SinCos tilt = sin_cos(pitch);
            const Vec3 forward(tilt.cos * azimuth.sin, tilt.sin, -tilt.cos * azimuth.cos);
            const CameraDesc camera = look_at(place.p, place.p + forward, fov);
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

/// Returns the highest free point of a room, near its centre.
Vec3 lamp_in(const World& world, const std::vector<VisibilityProbe>& room)
{
    const Bounds& bounds = world.bounds();
    const Vec3 center = 0.5f * (bounds.min + bounds.max);
    const float size = glm::length(bounds.max - bounds.min);
    Vec3 best = center;
    float best_score = -std::numeric_limits<float>::infinity();
    for (const VisibilityProbe& place : room) {
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

/// Returns a counter-clockwise rotation as seen from above.
glm::dmat3 turn_about_y(float angle)
{
    const SinCos exact = sin_cos(angle);
    const auto sine = static_cast<double>(exact.sin);
    const auto cosine = static_cast<double>(exact.cos);
    return {{cosine, 0.0, -sine}, {0.0, 1.0, 0.0}, {sine, 0.0, cosine}};
}

}  // namespace

FramedView frame_scene(const Scene& scene, float aspect, const FrameOptions& options)
{
    const World& world = scene.world();
    const ViewDirection direction =
        options.direction.value_or(direction_for(world.bounds().max - world.bounds().min));
    FramedView view;
    view.camera =
        frame_from_outside(world, axes_towards(direction), aspect, object_margin, options);
    view.lamp_position = Vec3(view.camera.world_from_camera[3]);
    if (options.direction || options.projection == Projection::orthographic) {
        return view;
    }

    const std::vector<VisibilityProbe> places = survey(world);
    const auto box = places_with(places, box_front, box_shell, 1.0f);
    if (box.size() >= box_places) {
        if (const auto towards_eye = missing_wall(box)) {
            const Mat3 axes(look_at(*towards_eye, Vec3(0.0f), outside_fov).world_from_camera);
            view.camera = frame_from_outside(world, axes, aspect, box_margin, options);
            view.lamp_position = lamp_in(world, box);
            return view;
        }
    }
    const auto closed = places_with(places, closed_front, closed_shell, closed_escape);
    if (closed.size() >= closed_places) {
        view.camera =
            frame_from_inside(world, closed, aspect, options.vertical_fov.value_or(inside_fov));
        view.lamp_position = lamp_in(world, closed);
        view.enclosed = probe_visibility(world, Vec3(view.camera.world_from_camera[3])).escaped <
                        enclosed_escape;
    }
    return view;
}

CameraDesc orbited(CameraDesc camera, Vec3 center, float angle)
{
    if (angle == 0.0f) {
        return camera;
    }
    glm::dmat4 turn(turn_about_y(angle));
    const glm::dvec3 c(center);
    turn[3] = glm::dvec4(c - glm::dvec3(turn * glm::dvec4(c, 0.0)), 1.0);
    camera.world_from_camera = Mat4(turn * glm::dmat4(camera.world_from_camera));
    for (Mat4& pose : camera.motion) {
        pose = Mat4(turn * glm::dmat4(pose));
    }
    return camera;
}

EnvironmentLightDesc turned(EnvironmentLightDesc environment, float angle)
{
    environment.world_from_environment =
        Mat3(turn_about_y(angle) * glm::dmat3(environment.world_from_environment));
    return environment;
}

}  // namespace bdpt
