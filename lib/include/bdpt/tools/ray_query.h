#pragma once

/// @file
/// Finds the first surface on a ray, and tells whether points see each other.
///
/// @code{.cpp}
/// void print_object(const bdpt::Scene& scene, bdpt::Vec3 eye, bdpt::Vec3 direction)
/// {
///     const auto hit = bdpt::first_hit(scene, eye, direction);
///     if (hit && hit->instance) {
///         const std::string& name = scene.description().instances[*hit->instance].name;
///         std::cout << name << ", " << hit->distance << " m away\n";
///     }
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene_ids.h>
#include <bdpt/types.h>

#include <cstdint>
#include <optional>

namespace bdpt {

class Scene;

/// The first intersection of a ray with a scene.
struct SurfaceHit {
    float distance = 0.0f;        ///< distance from the ray's origin [m]
    Vec3 position{0.0f};          ///< position in world space [m]
    Vec3 geometric_normal{0.0f};  ///< unit normal of the front side
    Vec3 shading_normal{0.0f};    ///< unit normal of the front side, interpolated and normal-mapped
    bool is_front = true;         ///< the ray arrives on the side of `geometric_normal`
    /// Index into `SceneDesc::instances`; nullopt: the sphere of a light with a radius.
    std::optional<std::uint32_t> instance{};
    std::uint32_t triangle = 0;  ///< index into the triangles of the instance's mesh
    Vec2 barycentrics{0.0f};     ///< weights of the second and the third vertex
    Vec2 uv{0.0f};               ///< TEXCOORD_0; 0 if the mesh has none
};

/// Returns the first hit of a ray, for tools such as picking and placing; nullopt if it hits
/// nothing. `direction` may have any length above 0, `time` is in [0, 1] while the shutter is open.
/// A surface with alpha is hit unless it is fully transparent there. Bit-identical on all machines
/// of one instruction set. May be called from several threads at once. Throws `Error` (usage) for
/// values that are not finite, a direction of 0, a time outside of [0, 1], and an origin that is
/// too far away for exact intersections.
///
///     if (const auto hit = bdpt::first_hit(scene, eye, forward)) {
///         std::cout << scene.description().instances[hit->instance.value()].name;
///     }
[[nodiscard]] BDPT_EXPORT std::optional<SurfaceHit> first_hit(const Scene& scene, Vec3 origin,
                                                              Vec3 direction, float time = 0.0f);

/// Tests whether no surface blocks the segment between two points. Fog and volumes are ignored. A
/// surface that contains one of the points may block it: move the point off it along the normal.
/// Throws like `first_hit`.
[[nodiscard]] BDPT_EXPORT bool is_visible(const Scene& scene, Vec3 from, Vec3 to,
                                          float time = 0.0f);

}  // namespace bdpt
