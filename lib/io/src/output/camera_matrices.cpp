#include "output/camera_matrices.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace bdpt::io {
namespace {

/// Removes the scale, which cameras ignore.
Mat4 rigid(const Mat4& world_from_camera)
{
    Mat4 result = world_from_camera;
    for (int axis = 0; axis < 3; ++axis) {
        result[axis] = Vec4(glm::normalize(Vec3(world_from_camera[axis])), 0.0f);
    }
    return result;
}

}  // namespace

Mat4 camera_from_file(const CameraDesc& camera, const DVec3& origin)
{
    Mat4 flip_z(1.0f);  // glTF looks along -z
    flip_z[2][2] = -1.0f;
    Mat4 result = flip_z * glm::inverse(rigid(camera.world_from_camera));
    result[3] = Vec4(Vec3(DVec3(result[3]) - glm::dmat3(result) * origin), 1.0f);
    return result;
}

Mat4 ndc_from_file(const CameraDesc& camera, const DVec3& origin, float aspect)
{
    if (camera.projection == Projection::orthographic) {
        // x' = x / width + 0.5, y' = -y / height + 0.5; the depth [m] is unchanged.
        const float height = camera.vertical_extent;
        const Mat4 projection(Vec4(1.0f / (aspect * height), 0.0f, 0.0f, 0.0f),
                              Vec4(0.0f, -1.0f / height, 0.0f, 0.0f), Vec4(0.0f, 0.0f, 1.0f, 0.0f),
                              Vec4(0.5f, 0.5f, 0.0f, 1.0f));
        return projection * camera_from_file(camera, origin);
    }
    // The remaining depth goes from 0 here to 1 at infinity.
    constexpr float near_plane = 0.01f;
    const float half_height = std::tan(0.5f * camera.vertical_fov);
    const float half_width = aspect * half_height;
    // Columns of x' = (0.5 x / half_width + 0.5 z) / z, y' = (-0.5 y / half_height + 0.5 z) / z.
    const Mat4 projection(Vec4(0.5f / half_width, 0.0f, 0.0f, 0.0f),
                          Vec4(0.0f, -0.5f / half_height, 0.0f, 0.0f), Vec4(0.5f, 0.5f, 1.0f, 1.0f),
                          Vec4(0.0f, 0.0f, -near_plane, 0.0f));
    return projection * camera_from_file(camera, origin);
}

}  // namespace bdpt::io
