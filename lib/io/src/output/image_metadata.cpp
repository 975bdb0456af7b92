#include <bdpt/io/write_image.h>

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <chrono>
#include <cmath>
#include <ctime>

#include "output/exr_output.h"
#include "output/image_output.h"

namespace bdpt::io {

std::vector<std::pair<std::string, std::string>> text_entries(const ImageMetadata& metadata)
{
    // The seed has 64 bits, more than the integers of the formats hold.
    std::vector<std::pair<std::string, std::string>> entries{
        {"bdpt.version", metadata.version},
        {"bdpt.scene", metadata.scene},
        {"bdpt.settings", metadata.settings},
        {"bdpt.integrator", metadata.integrator},
        {"bdpt.seed", std::to_string(metadata.seed)}};
    if (metadata.frame) {
        entries.emplace_back("bdpt.frame", std::to_string(metadata.frame->number));
    }
    if (!metadata.denoiser.empty()) {
        entries.emplace_back("bdpt.denoiser", metadata.denoiser);
    }
    if (!metadata.xmp.empty()) {
        entries.emplace_back("bdpt.xmp", metadata.xmp);
    }
    return entries;
}

std::vector<std::pair<std::string, std::string>> picture_text(const PngOptions& options)
{
    const ImageMetadata& metadata = options.metadata;
    const std::time_t created = std::chrono::system_clock::to_time_t(metadata.created);
    std::vector<std::pair<std::string, std::string>> text{
        {"Software", software_name(metadata)},
        {"Creation Time", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(created))},
        {"bdpt.spp", std::to_string(metadata.samples_per_pixel)},
        {"bdpt.renderTimeSeconds", fmt::format("{}", metadata.render_seconds)},
        {"bdpt.exposure", fmt::format("{}", options.exposure)},
        {"bdpt.toneMap", std::string(tone_curve_name(options.curve))}};
    for (auto& entry : text_entries(metadata)) {
        text.push_back(std::move(entry));
    }
    return text;
}

std::string software_name(const ImageMetadata& metadata)
{
    return "bdpt " + metadata.version;
}

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
    const Vec2 axis(0.5f - camera.shift.x, 0.5f + camera.shift.y);  // place in the image
    const float shape = aspect * camera.pixel_aspect;               // width over height of the film
    if (camera.projection == Projection::orthographic) {
        // x' = x / width + axis.x, y' = -y / height + axis.y; the depth [m] is unchanged.
        const float height = camera.vertical_extent;
        const Mat4 projection(Vec4(1.0f / (shape * height), 0.0f, 0.0f, 0.0f),
                              Vec4(0.0f, -1.0f / height, 0.0f, 0.0f), Vec4(0.0f, 0.0f, 1.0f, 0.0f),
                              Vec4(axis, 0.0f, 1.0f));
        return projection * camera_from_file(camera, origin);
    }
    // The remaining depth goes from 0 here to 1 at infinity.
    constexpr float near_plane = 0.01f;
    const float half_height = std::tan(0.5f * camera.vertical_fov);
    const float half_width = shape * half_height;
    // Columns of x' = (0.5 x / half_width + axis.x z) / z, y' = (-0.5 y / half_height + axis.y z) /
    // z.
    const Mat4 projection(Vec4(0.5f / half_width, 0.0f, 0.0f, 0.0f),
                          Vec4(0.0f, -0.5f / half_height, 0.0f, 0.0f), Vec4(axis, 1.0f, 1.0f),
                          Vec4(0.0f, 0.0f, -near_plane, 0.0f));
    return projection * camera_from_file(camera, origin);
}

}  // namespace bdpt::io
