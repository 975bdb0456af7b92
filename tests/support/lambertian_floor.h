#pragma once

#include "scene_builder.h"

namespace bdpt::test {

constexpr double pi_double = 3.14159265358979;
constexpr float floor_albedo = 0.5f;

/// Returns a Lambertian floor at y = 0 around the origin. Its radiance is albedo E / pi.
inline SceneBuilder lambertian_floor()
{
    SceneBuilder builder;
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, lambertian(Rgb(floor_albedo)));
    return builder;
}

/// Returns a camera that sees so small a patch of the floor around the origin that its irradiance E
/// is uniform.
inline CameraDesc patch_camera()
{
    return camera_at({0.3f, 0.4f, 0.5f}, {0.0f, 0.0f, 0.0f}, 1e-3f);
}

}  // namespace bdpt::test
