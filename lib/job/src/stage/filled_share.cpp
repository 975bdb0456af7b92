#include "stage/prepared_scene.h"

#include <bdpt/tools/ray_query.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt::job {

double filled_share(const Scene& scene, const CameraDesc& camera, float aspect)
{
    constexpr int side = 64;  // rays along each side of the image
    const bool is_parallel = camera.projection == Projection::orthographic;
    const float height =
        is_parallel ? 0.5f * camera.vertical_extent : std::tan(0.5f * camera.vertical_fov);
    const Vec3 back = normalize(Vec3(camera.world_from_camera[2]));
    const Vec3 right = normalize(cross(Vec3(camera.world_from_camera[1]), back));
    const Vec3 up = cross(back, right);
    const Vec3 eye(camera.world_from_camera[3]);
    const Vec2 axis = 1.0f + 2.0f * Vec2(-camera.shift.x, camera.shift.y);  // in half sizes
    const float width = aspect * camera.pixel_aspect;  // over the height of the view
    int hits = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Vec2 place = 2.0f * (Vec2(x, y) + 0.5f) / static_cast<float>(side) - axis;
            const Vec3 on_film = height * (width * place.x * right - place.y * up);
            hits += (is_parallel ? first_hit(scene, eye + on_film, -back)
                                 : first_hit(scene, eye, on_film - back))
                        ? 1
                        : 0;
        }
    }
    return static_cast<double>(hits) / (side * side);
}

}  // namespace bdpt::job
