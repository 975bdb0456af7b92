#include "camera/camera.h"

#include "math/elementary.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace bdpt {

Camera::Camera(const CameraDesc& desc, int width, int height)
    : Camera(desc, width, height, {.min = Vec2(0.0f), .max = Vec2(width, height)})
{}

Camera::Camera(const CameraDesc& desc, int width, int height, const RasterBounds& visible)
    : position_(desc.world_from_camera[3]), film_size_(width, height), visible_(visible)
{
    // Only where the camera looks and what is up for it count; scale and shear of its node do not.
    const Vec3 back = normalize(Vec3(desc.world_from_camera[2]));
    const Vec3 right = normalize(cross(Vec3(desc.world_from_camera[1]), back));
    world_from_camera_ = Mat3(right, cross(back, right), back);

    const SinCos half = sin_cos(0.5f * desc.vertical_fov);
    half_extent_.y = half.sin / half.cos;
    half_extent_.x = half_extent_.y * film_size_.x / film_size_.y;
    film_area_ = 4.0f * half_extent_.x * half_extent_.y;
}

CameraRay Camera::generate_ray(Vec2 raster) const
{
    const Vec2 ndc = 2.0f * raster / film_size_ - 1.0f;
    const Vec3 local(ndc.x * half_extent_.x, -ndc.y * half_extent_.y, -1.0f);
    const float length = std::sqrt(dot(local, local));  // one over the cosine at the lens
    return {.ray = {.origin = position_, .direction = world_from_camera_ * (local / length)},
            .pdf_direction = {length * length * length / film_area_}};
}

float Camera::depth(Vec3 scene_point) const
{
    return -dot(world_from_camera_[2], scene_point - position_);
}

std::optional<LensSample> Camera::sample_lens(Vec3 scene_point) const
{
    const Vec3 to_point = scene_point - position_;
    const Vec3 local = transpose(world_from_camera_) * to_point;
    if (!(local.z < 0.0f)) {
        return std::nullopt;
    }
    const Vec2 ndc = Vec2(local.x, -local.y) / (-local.z * half_extent_);
    const Vec2 raster = 0.5f * (ndc + 1.0f) * film_size_;
    const bool inside = raster.x >= visible_.min.x && raster.x < visible_.max.x &&
                        raster.y >= visible_.min.y && raster.y < visible_.max.y;
    if (!inside) {
        return std::nullopt;
    }
    const float distance = std::sqrt(dot(to_point, to_point));
    const float inv_cos = distance / -local.z;
    const float pdf_direction = inv_cos * inv_cos * inv_cos / film_area_;
    // We = 1 / (A cos^4) [Pharr et al. 2016, sec. 16.1.1], so We cos is the density of direction.
    return LensSample{.p = position_,
                      .wi = -to_point / distance,
                      .distance = distance,
                      .raster = raster,
                      .weight = pdf_direction / (distance * distance),
                      .pdf_direction = {pdf_direction}};
}

}  // namespace bdpt
