#include "camera/camera.h"

#include "geometry/motion.h"
#include "math/elementary.h"
#include "math/warp.h"

#include <bdpt/thin_lens.h>
#include <bdpt/tools/intrinsics.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace bdpt {

Camera::Camera(const CameraDesc& desc, int width, int height)
    : Camera(desc, width, height, {.min = Vec2(0.0f), .max = Vec2(width, height)})
{}

Camera::Camera(const CameraDesc& desc, int width, int height, const RasterBounds& visible,
               MediumId medium)
    : medium_(medium),
      film_size_(width, height),
      visible_(visible),
      perspective_(desc.projection == Projection::perspective),
      lens_radius_(perspective_ ? desc.lens_radius : 0.0f),
      focus_distance_(lens_radius_ > 0.0f ? desc.focus_distance : 1.0f)
{
    look_from(desc.world_from_camera);
    const SinCos half = sin_cos(0.5f * desc.vertical_fov);
    half_extent_.y = perspective_ ? half.sin / half.cos : 0.5f * desc.vertical_extent;
    half_extent_.x = half_extent_.y * film_size_.x / film_size_.y * desc.pixel_aspect;
    axis_ = Vec2(1.0f - 2.0f * desc.shift.x, 1.0f + 2.0f * desc.shift.y);
    film_area_ = 4.0f * half_extent_.x * half_extent_.y;
    if (has_finite_lens()) {
        pdf_lens_ = {1.0f / (pi * lens_radius_ * lens_radius_)};
    }
    const float pixel = 2.0f * half_extent_.y / film_size_.y * std::min(desc.pixel_aspect, 1.0f);
    pixel_cone_.width = perspective_ ? 0.0f : pixel;
    pixel_cone_.spread = perspective_ ? pixel : 0.0f;
}

void Camera::look_from(const Mat4& world_from_camera)
{
    // Only the viewing direction and the up direction matter; scale and shear of the node are
    // ignored.
    const Vec3 back = normalize(Vec3(world_from_camera[2]));
    const Vec3 right = normalize(cross(Vec3(world_from_camera[1]), back));
    world_from_camera_ = Mat3(right, cross(back, right), back);
    position_ = Vec3(world_from_camera[3]);
    pixel_cone_.eye = position_;
}

Camera Camera::moved_to(const Mat4& world_from_camera) const
{
    Camera result = *this;
    result.look_from(world_from_camera);
    return result;
}

Vec3 Camera::to_local(Vec3 world_vector) const
{
    return transpose(world_from_camera_) * world_vector;
}

bool Camera::is_visible(Vec2 raster) const
{
    return raster.x >= visible_.min.x && raster.x < visible_.max.x && raster.y >= visible_.min.y &&
           raster.y < visible_.max.y;
}

Vec3 Camera::lens_point(Vec2 u_lens) const
{
    return has_finite_lens() ? Vec3(lens_radius_ * square_to_disk(u_lens), 0.0f) : Vec3(0.0f);
}

SegmentEnd Camera::lens_end(Vec3 local_point) const
{
    return {.p = position_ + world_from_camera_ * local_point,
            .ng = has_finite_lens() ? -world_from_camera_[2] : Vec3(0.0f),
            .media = SideMedia::around(medium_)};
}

SolidAnglePdf Camera::compute_pdf(float inv_cos) const
{
    // For each point on the lens the film is seen as the plane of focus: A cos^-3 in its units.
    return {inv_cos * inv_cos * inv_cos / film_area_};
}

Vec2 Camera::compute_raster(Vec3 lens, Vec3 d) const
{
    const Vec3 in_focus = lens + d * (focus_distance_ / -d.z);
    const Vec2 ndc = Vec2(in_focus.x, -in_focus.y) / (focus_distance_ * half_extent_);
    return 0.5f * (ndc + axis_) * film_size_;
}

Vec2 Camera::compute_parallel_raster(Vec3 local_point) const
{
    const Vec2 ndc = Vec2(local_point.x, -local_point.y) / half_extent_;
    return 0.5f * (ndc + axis_) * film_size_;
}

CameraRay Camera::generate_ray(Vec2 raster, Vec2 u_lens) const
{
    const Vec2 ndc = 2.0f * raster / film_size_ - axis_;
    const Vec2 on_film(ndc.x * half_extent_.x, -ndc.y * half_extent_.y);
    if (!perspective_) {
        return {.lens = lens_end({on_film, 0.0f}),
                .direction = -world_from_camera_[2],
                .pdf_lens = pdf_lens_,
                .pdf_direction = {},
                .pdf_plane = PlanarPdf{1.0f / film_area_}};
    }
    const Vec3 lens = lens_point(u_lens);
    const Vec3 local = Vec3(on_film, -1.0f) * focus_distance_ - lens;
    const float length = std::sqrt(dot(local, local));
    return {.lens = lens_end(lens),
            .direction = world_from_camera_ * (local / length),
            .pdf_lens = pdf_lens_,
            .pdf_direction = compute_pdf(length / focus_distance_),
            .pdf_plane = std::nullopt};
}

float Camera::depth(Vec3 scene_point) const
{
    return -dot(world_from_camera_[2], scene_point - position_);
}

std::optional<Vec2> Camera::project(Vec3 scene_point) const
{
    const Vec3 local = to_local(scene_point - position_);
    if (!(local.z < 0.0f)) {
        return std::nullopt;
    }
    return perspective_ ? compute_raster(Vec3(0.0f), local) : compute_parallel_raster(local);
}

std::optional<LensSample> Camera::sample_lens(Vec3 scene_point, Vec2 u_lens) const
{
    std::optional<LensSample> sampled;  // constructed in place of the result
    const Vec3 local = to_local(scene_point - position_);
    if (!(local.z < 0.0f)) {
        return sampled;
    }
    if (!perspective_) {
        const Vec2 raster = compute_parallel_raster(local);
        if (!is_visible(raster)) {
            return sampled;
        }
        sampled.emplace();
        sampled->lens = lens_end({local.x, local.y, 0.0f});
        sampled->wi = world_from_camera_[2];
        sampled->distance = -local.z;
        sampled->raster = raster;
        sampled->pdf_lens = pdf_lens_;
        sampled->pdf_plane = PlanarPdf{1.0f / film_area_};
        sampled->weight = sampled->pdf_plane->value;
        return sampled;
    }
    const Vec3 lens = lens_point(u_lens);
    const Vec3 d = local - lens;
    const Vec2 raster = compute_raster(lens, d);
    if (!is_visible(raster)) {
        return sampled;
    }
    const float distance = std::sqrt(dot(d, d));
    const SolidAnglePdf pdf_direction = compute_pdf(distance / -d.z);
    // We = 1 / (A pi r^2 cos^4) [Pharr et al. 2016, sec. 16.1.1], so We cos is the density of
    // direction times that of the lens point.
    sampled.emplace();
    sampled->lens = lens_end(lens);
    sampled->wi = world_from_camera_ * (-d * (1.0f / distance));
    sampled->distance = distance;
    sampled->raster = raster;
    sampled->weight = pdf_direction.value / (distance * distance);
    sampled->pdf_lens = pdf_lens_;
    sampled->pdf_direction = pdf_direction;
    return sampled;
}

std::optional<LensHit> Camera::hit_lens(Vec3 origin, Vec3 direction) const
{
    const Vec3 d = to_local(direction);
    const Vec3 from = to_local(origin - position_);
    if (!has_finite_lens() || !(d.z > 0.0f) || !(from.z < 0.0f)) {
        return std::nullopt;
    }
    const float distance = -from.z / d.z;
    const Vec3 lens(Vec2(from) + distance * Vec2(d), 0.0f);
    if (dot(lens, lens) > lens_radius_ * lens_radius_) {
        return std::nullopt;
    }
    const Vec2 raster = compute_raster(lens, -d);
    if (!is_visible(raster)) {
        return std::nullopt;
    }
    const SolidAnglePdf pdf_direction = compute_pdf(1.0f / d.z);
    return LensHit{.lens = lens_end(lens),
                   .distance = distance,
                   .raster = raster,
                   .importance = pdf_direction.value * pdf_lens_.value / d.z,
                   .pdf_lens = pdf_lens_,
                   .pdf_direction = pdf_direction};
}

Camera MovingCamera::at(float time) const
{
    return moves() ? first_.moved_to(at_time(pose_, std::span<const Mat4>(motion_), time)) : first_;
}

namespace {

constexpr double half_sensor = 0.012;  // [m]

}  // namespace

double compute_lens_radius(double f_number, double vertical_fov)
{
    const SinCos half = sin_cos(static_cast<float>(0.5 * vertical_fov));
    const double focal_length =
        half_sensor * static_cast<double>(half.cos) / static_cast<double>(half.sin);
    return focal_length / (2.0 * f_number);
}

double compute_vertical_fov(double focal_length)
{
    const auto half =
        atan2_exact(static_cast<float>(half_sensor), static_cast<float>(focal_length));
    return 2.0 * static_cast<double>(half);
}

Intrinsics intrinsics(const CameraDesc& camera, int width, int height)
{
    const double fy = focal_length(static_cast<double>(camera.vertical_fov), height);
    return {.fx = fy / static_cast<double>(camera.pixel_aspect),
            .fy = fy,
            .cx = width * (0.5 - static_cast<double>(camera.shift.x)),
            .cy = height * (0.5 + static_cast<double>(camera.shift.y))};
}

void set_intrinsics(CameraDesc& camera, const Intrinsics& values, int width, int height)
{
    camera.vertical_fov = static_cast<float>(angle_of_view(values.fy, height));
    camera.pixel_aspect = static_cast<float>(values.fy / values.fx);
    camera.shift = Vec2(0.5 - values.cx / width, values.cy / height - 0.5);
}

double focal_length(double angle, int extent)
{
    const SinCos half = sin_cos(0.5f * static_cast<float>(angle));
    return 0.5 * extent * static_cast<double>(half.cos) / static_cast<double>(half.sin);
}

double angle_of_view(double focal_length, int extent)
{
    return 2.0 *
           static_cast<double>(atan2_exact(static_cast<float>(0.5 * extent / focal_length), 1.0f));
}

}  // namespace bdpt
