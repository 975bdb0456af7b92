#include "scene/framing/visibility_probe.h"

#include "math/elementary.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

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
    const SinCos half = sin_cos(0.5f * camera.vertical_fov);
    const float slope = half.sin / half.cos;
    const Mat3 axes(camera.world_from_camera);
    const Vec3 eye(camera.world_from_camera[3]);
    float sum = 0.0f;
    for (int i = 0; i < columns * rows; ++i) {
        const float x = (static_cast<float>(i % columns) + 0.5f) / columns * 2.0f - 1.0f;
        const float y = (static_cast<float>(i / columns) + 0.5f) / rows * 2.0f - 1.0f;
        const Vec3 direction = normalize(axes * Vec3(x * slope * aspect, y * slope, -1.0f));
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

}  // namespace bdpt
