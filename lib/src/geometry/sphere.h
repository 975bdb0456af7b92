#pragma once

#include "geometry/placed_mesh.h"
#include "geometry/ray.h"

#include <bdpt/types.h>

#include <optional>
#include <span>

namespace bdpt {

/// The surface of a sphere. Its normals point outwards.
struct Sphere {
    Vec3 center{0.0f};
    float radius = 1.0f;             ///< [m], > 0
    std::span<const Vec3> motion{};  ///< of the centre, as in `PointLightDesc`; owned by others

    /// Where it is at a time in [0, 1], standing still.
    [[nodiscard]] Sphere at(float time) const;

    /// The point whose unit normal is given, with a bound of how far it may lie off the surface.
    [[nodiscard]] BoundedPoint point(Vec3 normal) const;
};

/// Where a ray met a sphere.
struct SphereHit {
    float t = 0.0f;     ///< in units of the ray's direction
    Vec3 normal{0.0f};  ///< unit, outwards
};

/// The first crossing in (t_min, ray.t_max), from outside or from inside. Computed in double, so
/// that spheres that are tiny or far away keep their outline.
[[nodiscard]] std::optional<SphereHit> intersect(const Sphere& sphere, const Ray& ray,
                                                 float t_min) noexcept;

}  // namespace bdpt
