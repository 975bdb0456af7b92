#include "scene/framing/framing.h"

#include "math/elementary.h"
#include "math/frame.h"
#include "math/warp.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace bdpt {
namespace {

bool near_bounds(const Bounds& bounds, Vec3 p)
{
    constexpr float shell = 0.12f;  // fraction of the scene's extent along that axis
    const Vec3 extent = bounds.max - bounds.min;
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] - bounds.min[axis] < shell * extent[axis] ||
            bounds.max[axis] - p[axis] < shell * extent[axis]) {
            return true;
        }
    }
    return false;
}

/// Returns the end of the `i`-th ray of a probe, without what the surface there does to light.
std::optional<SegmentEnd> find_end(const World& world, Vec3 origin, Vec3 direction, int i)
{
    const SegmentKey key{static_cast<std::uint64_t>(i)};
    const auto hit = world.first_hit({.p = origin}, direction, key);
    return hit ? std::optional(world.end_at(*hit, direction, key.time)) : std::nullopt;
}

/// Returns the direction of a ray through the image, `x` and `y` in [-1, 1].
Vec3 direction_through(const CameraDesc& camera, float aspect, float x, float y)
{
    const SinCos half = sin_cos(0.5f * camera.vertical_fov);
    const float slope = half.sin / half.cos;
    return normalize(Mat3(camera.world_from_camera) * Vec3(x * slope * aspect, y * slope, -1.0f));
}

/// Returns point `i` of the sequence R2, in [0, 1)^2.
Vec2 r2_point(int i)
{
    const Vec2 at = 0.5f + static_cast<float>(i) * Vec2(0.7548777f, 0.5698403f);
    return at - glm::floor(at);
}

/// Tests whether a lamp illuminates the side of a surface that `normal` points to.
bool is_lit_by(const World& world, Vec3 lamp, const SegmentEnd& surface, Vec3 normal, int path)
{
    return dot(lamp - surface.p, normal) > 0.0f &&
           world.transmission({.p = lamp}, surface, SegmentKey{static_cast<std::uint64_t>(path)})
               .has_value();
}

}  // namespace

VisibilityProbe probe_visibility(const World& world, Vec3 p)
{
    constexpr int directions = 200;
    constexpr float golden_angle = 2.3999632f;
    VisibilityProbe result{.p = p};
    result.clearance = std::numeric_limits<float>::infinity();
    for (int i = 0; i < directions; ++i) {
        // Directions of a Fibonacci spiral cover the sphere evenly.
        const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / directions;
        const float r = std::sqrt(1.0f - y * y);
        const SinCos phi = sin_cos(golden_angle * static_cast<float>(i));
        const Vec3 direction(r * phi.cos, y, r * phi.sin);
        const auto hit = find_end(world, p, direction, i);
        if (!hit) {
            result.escaped += 1.0f / directions;
            result.escape_direction += direction;
            continue;
        }
        result.clearance = std::min(result.clearance, glm::distance(p, hit->p));
        if (dot(hit->ng, direction) < 0.0f) {
            result.front += 1.0f / directions;
            result.shell += near_bounds(world.bounds(), hit->p) ? 1.0f / directions : 0.0f;
        }
    }
    if (result.escaped > 0.0f) {
        result.escape_direction /= result.escaped * static_cast<float>(directions);
    }
    return result;
}

float view_depth(const World& world, const CameraDesc& camera, float aspect)
{
    constexpr int columns = 8;
    constexpr int rows = 6;
    const float size = glm::length(world.bounds().max - world.bounds().min);
    const float too_near = 0.06f * size;
    const Vec3 eye(camera.world_from_camera[3]);
    float sum = 0.0f;
    for (int i = 0; i < columns * rows; ++i) {
        const float x = (static_cast<float>(i % columns) + 0.5f) / columns * 2.0f - 1.0f;
        const float y = (static_cast<float>(i / columns) + 0.5f) / rows * 2.0f - 1.0f;
        const Vec3 direction = direction_through(camera, aspect, x, y);
        const auto hit = find_end(world, eye, direction, i);
        const float distance = hit ? glm::distance(eye, hit->p) : size;
        const bool behind = hit && dot(hit->ng, direction) > 0.0f;
        if (distance < too_near || behind) {
            return 0.0f;
        }
        sum += distance;
    }
    return sum / (columns * rows);
}

ViewPilot pilot_view(const World& world, const CameraDesc& camera, float aspect, Vec3 lamp)
{
    constexpr int side = 8;
    constexpr int vertices = 3;
    const float size = glm::length(world.bounds().max - world.bounds().min);
    ViewPilot result;
    std::vector<float> distances;
    for (int path = 0; path < side * side; ++path) {
        const float x = (static_cast<float>(path % side) + 0.5f) / side * 2.0f - 1.0f;
        const float y = (static_cast<float>(path / side) + 0.5f) / side * 2.0f - 1.0f;
        SegmentEnd from{.p = Vec3(camera.world_from_camera[3])};
        Vec3 direction = direction_through(camera, aspect, x, y);
        float share = 1.0f / (side * side);
        for (int vertex = 0; vertex < vertices; ++vertex) {
            const int segment = path * vertices + vertex;
            const SegmentKey key{static_cast<std::uint64_t>(segment)};
            const auto hit = world.first_hit(from, direction, key);
            const SegmentEnd end = hit ? world.end_at(*hit, direction, key.time) : SegmentEnd{};
            if (vertex == 0) {
                distances.push_back(hit ? glm::distance(from.p, end.p) : size);
            }
            const Vec3 normal = dot(end.ng, direction) < 0.0f ? end.ng : -end.ng;
            if (!hit || is_lit_by(world, lamp, end, normal, segment)) {
                result.lit += share;
                break;
            }
            share *= 0.5f;
            from = end;
            direction =
                Frame::from_normal(normal).to_world(square_to_cosine_hemisphere(r2_point(segment)));
        }
    }
    const auto middle = distances.begin() + side * side / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    result.median_distance = *middle;
    return result;
}

}  // namespace bdpt
