#include <bdpt/framing.h>

#include "math/elementary.h"
#include "scene/framing/framing.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
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

// Candidates for a view from inside.
constexpr float inside_aspect = 16.0f / 9.0f;  // whatever that of the image is
constexpr std::size_t eyes_of_room = 8;
constexpr std::size_t lamps_of_eye = 4;
constexpr float view_ahead = 2.0f;  // distance of what is seen, in clearances of the eye
constexpr float well_lit = 0.6f;    // share of light that suffices

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
    const Vec3 right(azimuth.cos, 0.0f, -azimuth.sin);
    const Vec3 back = unit_vector(direction);
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

/// Returns how well a place of a room suits an eye by its height, in [0.5, 1].
float eye_height_score(const World& world, Vec3 p)
{
    const Bounds& bounds = world.bounds();
    const float eye_height = bounds.min.y + 0.55f * (bounds.max.y - bounds.min.y);
    const float height = std::max(bounds.max.y - bounds.min.y, 1e-6f);
    return 1.0f - 0.5f * std::abs(p.y - eye_height) / height;
}

/// A view from inside and its score.
struct ScoredView {
    CameraDesc camera;
    float score = 0.0f;
};

/// Returns the view from a place that sees farthest with nothing right in front of the lens.
ScoredView farthest_view(const World& world, Vec3 eye)
{
    constexpr int azimuths = 16;
    constexpr float pitch = -0.12f;  // slightly downwards
    ScoredView best{.camera = look_at(eye, eye + Vec3(0.0f, 0.0f, -1.0f), inside_fov)};
    for (int i = 0; i < azimuths; ++i) {
        const SinCos azimuth = sin_cos(2.0f * pi * static_cast<float>(i) / azimuths);
        const SinCos tilt = sin_cos(pitch);
        const Vec3 forward(tilt.cos * azimuth.sin, tilt.sin, -tilt.cos * azimuth.cos);
        const CameraDesc camera = look_at(eye, eye + forward, inside_fov);
        const float score = view_depth(world, camera, inside_aspect) * eye_height_score(world, eye);
        if (score > best.score) {
            best = {.camera = camera, .score = score};
        }
    }
    return best;
}

/// Returns the places of a room that suit a lamp, the best first: the highest near `target`, with
/// some room around.
std::vector<VisibilityProbe> lamp_places(const World& world, std::vector<VisibilityProbe> room,
                                         Vec3 target)
{
    const float size = glm::length(world.bounds().max - world.bounds().min);
    const auto score = [&](const VisibilityProbe& place) {
        const Vec3 offset = place.p - target;
        const float aside = std::sqrt(offset.x * offset.x + offset.z * offset.z);
        return offset.y - aside - (place.clearance < 0.02f * size ? size : 0.0f);
    };
    std::stable_sort(room.begin(), room.end(),
                     [&](const auto& a, const auto& b) { return score(a) > score(b); });
    return room;
}

/// Returns the highest free point of a room, near its centre.
Vec3 lamp_in(const World& world, const std::vector<VisibilityProbe>& room)
{
    return lamp_places(world, room, 0.5f * (world.bounds().min + world.bounds().max)).front().p;
}

/// Returns four places for a lamp in the view from an eye: that of the whole room, the best two
/// that the eye sees, and one right above the eye, whose light reaches all that is seen.
std::vector<Vec3> lamps_for(const World& world, const std::vector<VisibilityProbe>& room,
                            const VisibilityProbe& eye, Vec3 forward)
{
    std::vector<Vec3> lamps{lamp_in(world, room)};
    const float ahead = view_ahead * eye.clearance;
    for (const VisibilityProbe& place : lamp_places(world, room, eye.p + ahead * forward)) {
        const bool is_seen =
            place.p != eye.p &&
            world.transmission({.p = eye.p}, {.p = place.p}, SegmentKey{}).has_value();
        if (is_seen && lamps.size() < lamps_of_eye - 1) {
            lamps.push_back(place.p);
        }
    }
    lamps.resize(lamps_of_eye, eye.p + Vec3(0.0f, 0.5f * eye.clearance, 0.0f));
    return lamps;
}

/// A view from inside, and the lamp for it.
struct InsideView {
    CameraDesc camera;
    Vec3 lamp{0.0f};
};

/// Chooses among the eyes that see farthest, and lamps for each, by what a pilot sees. Its cost
/// does not depend on the size of the scene, but for that of a ray.
InsideView frame_from_inside(const World& world, const std::vector<VisibilityProbe>& room)
{
    struct Eye {
        const VisibilityProbe* place;
        ScoredView view;
    };
    std::vector<Eye> eyes;
    for (const VisibilityProbe& place : room) {
        eyes.push_back({.place = &place, .view = farthest_view(world, place.p)});
    }
    std::stable_sort(eyes.begin(), eyes.end(),
                     [](const Eye& a, const Eye& b) { return a.view.score > b.view.score; });
    eyes.resize(std::min(eyes.size(), eyes_of_room));
    InsideView best{.camera = eyes.front().view.camera, .lamp = lamp_in(world, room)};
    float best_score = 0.0f;
    for (const Eye& eye : eyes) {
        const CameraDesc& camera = eye.view.camera;
        const Vec3 forward = -Vec3(camera.world_from_camera[2]);
        for (const Vec3 lamp : lamps_for(world, room, *eye.place, forward)) {
            const ViewPilot pilot = pilot_view(world, camera, inside_aspect, lamp);
            // A view is as deep as half of it: a hole alone does not count.
            const float depth = std::min(eye.view.score, 2.0f * pilot.median_distance *
                                                             eye_height_score(world, eye.place->p));
            const float score = depth * std::min(1.0f, pilot.lit / well_lit);
            if (score > best_score) {
                best_score = score;
                best = {.camera = camera, .lamp = lamp};
            }
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

Vec3 unit_vector(const ViewDirection& direction)
{
    const SinCos azimuth = sin_cos(direction.azimuth);
    const SinCos elevation = sin_cos(direction.elevation);
    return {elevation.cos * azimuth.sin, elevation.sin, elevation.cos * azimuth.cos};
}

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
            view.room = true;
            return view;
        }
    }
    const auto closed = places_with(places, closed_front, closed_shell, closed_escape);
    if (closed.size() >= closed_places) {
        InsideView inside = frame_from_inside(world, closed);
        view.camera = std::move(inside.camera);
        view.camera.vertical_fov = options.vertical_fov.value_or(inside_fov);
        view.lamp_position = inside.lamp;
        view.inside = true;
        view.room = true;
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
