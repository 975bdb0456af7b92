#pragma once

#include "geometry/placed_mesh.h"
#include "geometry/ray.h"

#include <bdpt/types.h>

#include <optional>
#include <span>

namespace bdpt {

/// The surface of a sphere. Normals point outwards.
struct Sphere {
    Vec3 center{0.0f};
    float radius = 1.0f;             ///< [m], > 0
    std::span<const Vec3> motion{};  ///< later centres, as in `PointLightDesc`; not owned

    /// Returns the static sphere at a time in [0, 1].
    [[nodiscard]] Sphere at(float time) const;

    /// Returns the point with the unit normal `normal`, and a bound of its distance from the
    /// surface.
    [[nodiscard]] BoundedPoint point(Vec3 normal) const;
};

/// Hit of a sphere.
struct SphereHit {
    float t = 0.0f;     ///< in units of the ray's direction
    Vec3 normal{0.0f};  ///< unit, outwards
};

/// Returns the first hit in (t_min, ray.t_max), from outside or from inside. Computed in double
/// precision, so that tiny or distant spheres keep their outline.
[[nodiscard]] std::optional<SphereHit> intersect(const Sphere& sphere, const Ray& ray,
                                                 float t_min) noexcept;

}  // namespace bdpt
