#pragma once

#include <bdpt/scene_desc.h>

#include "scene_builder.h"

namespace bdpt::test {

/// A grey floor of 2 m x 2 m below a small lamp, seen from the side.
[[nodiscard]] inline SceneDesc lit_floor()
{
    return SceneBuilder()
        .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, lambertian(Rgb(0.5f)))
        .quad({-0.2f, 1, -0.2f}, {0.2f, 1, -0.2f}, {0.2f, 1, 0.2f}, {-0.2f, 1, 0.2f},
              emitter(Rgb(20.0f)))
        .desc;
}

/// Looks down -z from 3 m away, a little above the floor.
[[nodiscard]] inline CameraDesc floor_camera()
{
    CameraDesc camera;
    camera.name = "side";
    camera.world_from_camera[3] = Vec4(0.0f, 0.5f, 3.0f, 1.0f);
    return camera;
}

}  // namespace bdpt::test
