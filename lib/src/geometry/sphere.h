#pragma once

#include "geometry/motion.h"
#include "geometry/ray.h"

#include <bdpt/types.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace bdpt {

/// Hit of a sphere.
struct SphereHit {
    float t = 0.0f;     ///< in units of the ray's direction
    Vec3 normal{0.0f};  ///< unit, outwards
};

/// The surface of a sphere. Normals point outwards.
struct Sphere {
    Vec3 center{0.0f};
    float radius = 1.0f;             ///< [m], > 0
    std::span<const Vec3> motion{};  ///< later centres, as in `PointLightDesc`; not owned

    /// Returns the static sphere at a time in [0, 1].
    [[nodiscard]] Sphere at(float time) const
    {
        return {.center = at_time(center, motion, time), .radius = radius};
    }

    /// Returns the point with the unit normal `normal`, and a bound of its distance from the
    /// surface.
    [[nodiscard]] BoundedPoint point(Vec3 normal) const
    {
        // Roundings of the unit normal, its product and the sum; rays are tested in double.
        constexpr int rounded_operations = 8;
        const Vec3 size = abs(center) + radius;
        return {center + radius * normal,
                rounding_bound(rounded_operations) * std::max(size.x, std::max(size.y, size.z))};
    }
};

/// Returns the first hit in (t_min, ray.t_max), from outside or from inside. Computed in double
/// precision, so that tiny or distant spheres keep their outline.
[[nodiscard]] inline std::optional<SphereHit> intersect(const Sphere& sphere, const Ray& ray,
                                                        float t_min) noexcept
{
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 to_center = glm::dvec3(sphere.center) - glm::dvec3(ray.origin);
    const auto radius = static_cast<double>(sphere.radius);
    const double length_squared = dot(direction, direction);
    const double nearest = dot(to_center, direction) / length_squared;
    // Vector from the centre to the nearest point of the line.
    const glm::dvec3 aside = nearest * direction - to_center;
    const double half_chord_squared = radius * radius - dot(aside, aside);
    if (!(half_chord_squared >= 0.0)) {
        return std::nullopt;
    }
    const double half = std::sqrt(half_chord_squared / length_squared);
    const auto least = static_cast<double>(t_min);
    const double entry = nearest - half;
    const double t = entry > least ? entry : nearest + half;
    if (!(t > least && t < static_cast<double>(ray.t_max))) {
        return std::nullopt;
    }
    return SphereHit{.t = static_cast<float>(t),
                     .normal = Vec3(normalize(aside + (t - nearest) * direction))};
}

}  // namespace bdpt
