#pragma once

#include <bdpt/export.h>
#include <bdpt/scene_ids.h>
#include <bdpt/types.h>

#include <cstdint>
#include <optional>

namespace bdpt {

class Scene;

/// Where a ray meets the first surface of a scene.
struct SurfaceHit {
    float distance = 0.0f;        ///< from the origin of the ray [m]
    Vec3 position{0.0f};          ///< in world space [m]
    Vec3 geometric_normal{0.0f};  ///< unit, on the front of the surface
    Vec3 shading_normal{0.0f};    ///< unit, interpolated and with the normal map, likewise
    bool is_front = true;         ///< the ray comes from the side of `geometric_normal`
    /// Index into `SceneDesc::instances`; none: the sphere of a light with a radius.
    std::optional<std::uint32_t> instance{};
    std::uint32_t triangle = 0;  ///< index into the triangles of the instance's mesh
    Vec2 barycentrics{0.0f};     ///< weights of the second and the third corner
    Vec2 uv{0.0f};               ///< TEXCOORD_0; 0 where the mesh has none
};

/// The first surface that a ray meets, for tools such as picking and placing. `direction` may have
/// any length above 0, `time` is in [0, 1] while the shutter is open. Where a surface has alpha,
/// the ray meets it unless it is wholly transparent there. The same bits on all machines of one
/// instruction set. May be called from several threads at once. Throws `Error` (usage) for values
/// that are not finite, a direction of 0, a time outside of [0, 1], and an origin that is too far
/// away for exact intersections.
///
///     if (const auto hit = bdpt::first_hit(scene, eye, forward)) {
///         std::cout << scene.description().instances[hit->instance.value()].name;
///     }
[[nodiscard]] BDPT_EXPORT std::optional<SurfaceHit> first_hit(const Scene& scene, Vec3 origin,
                                                              Vec3 direction, float time = 0.0f);

/// Is the straight line between two points free of surfaces? Fog and volumes do not count. A
/// surface that one of the points lies on may count: move the point off it along the normal. Throws
/// what `first_hit` does.
[[nodiscard]] BDPT_EXPORT bool is_visible(const Scene& scene, Vec3 from, Vec3 to,
                                          float time = 0.0f);

}  // namespace bdpt
