#include "math/random_numbers.h"
#include "scene/world.h"

#include <bdpt/error.h>
#include <bdpt/scene.h>
#include <bdpt/tools/ray_query.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <string>

namespace bdpt {
namespace {

bool has_finite_values(Vec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string coordinates_text(Vec3 v)
{
    return std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
}

/// Returns the end of a ray at `p`; throws if it is not finite or too far away.
SegmentEnd checked_end(const World& world, const char* name, Vec3 p)
{
    if (!has_finite_values(p)) {
        throw Error(ErrorCode::usage, std::string("ray query: ") + name + " is not finite");
    }
    if (glm::length(p) > world.farthest_origin()) {
        throw Error(ErrorCode::usage, std::string("ray query: ") + name + " " +
                                          coordinates_text(p) + " is too far away from the scene");
    }
    SegmentEnd end{.p = p};
    end.media = SideMedia::around(world.medium_at(p));
    return end;
}

/// Returns a key with which rays hit every surface that is not fully transparent.
SegmentKey checked_key(float time)
{
    if (!(time >= 0.0f && time <= 1.0f)) {
        throw Error(ErrorCode::usage,
                    "ray query: time is " + std::to_string(time) + ", not in [0, 1]");
    }
    return SegmentKey{.time = time}.without_chance();
}

}  // namespace

std::optional<SurfaceHit> first_hit(const Scene& scene, Vec3 origin, Vec3 direction, float time)
{
    const World& world = scene.world();
    const SegmentKey key = checked_key(time);
    const SegmentEnd from = checked_end(world, "origin", origin);
    const float length = glm::length(direction);
    if (!has_finite_values(direction) || !(length > 0.0f) || !std::isfinite(length)) {
        throw Error(ErrorCode::usage, "ray query: direction " + coordinates_text(direction) +
                                          " has no finite length above 0");
    }
    const Vec3 unit = direction / length;
    const std::optional<RayHit> met = world.first_hit(from, unit, key);
    if (!met) {
        return std::nullopt;
    }
    const SurfacePoint point = world.surface_at(*met, unit, key, PixelCone{});
    SurfaceHit hit{.distance = glm::distance(origin, point.end.p),
                   .position = point.end.p,
                   .geometric_normal = point.end.ng,
                   .shading_normal = point.bsdf.shading_normal(),
                   .is_front = glm::dot(unit, point.end.ng) < 0.0f};
    if (glm::dot(hit.shading_normal, hit.geometric_normal) < 0.0f) {
        hit.shading_normal = -hit.shading_normal;
    }
    if (met->sphere == no_sphere) {
        hit.instance = met->instance;
        hit.triangle = met->triangle;
        hit.barycentrics = point.barycentrics;
        hit.uv = world.geometry().placed[met->instance].uv(met->triangle, point.barycentrics)[0];
    }
    return hit;
}

bool is_visible(const Scene& scene, Vec3 from, Vec3 to, float time)
{
    const World& world = scene.world();
    const SegmentKey key = checked_key(time);
    const SegmentEnd a = checked_end(world, "first point", from);
    const SegmentEnd b = checked_end(world, "second point", to);
    return from == to || world.transmission(a, b, key).has_value();
}

}  // namespace bdpt
