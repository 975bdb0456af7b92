#include "dataset/dataset.h"

#include <bdpt/framing.h>
#include <bdpt/io/json_value.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/tools/intrinsics.h>
#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace bdpt::job {
namespace {

using nlohmann::ordered_json;

using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;

/// SplitMix64's function of a counter [Steele et al. 2014, "Fast splittable pseudorandom number
/// generators", fig. 16].
std::uint64_t mixed(std::uint64_t value)
{
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
    return value ^ (value >> 31);
}

/// Number of the draws of a model that are not those of a view.
constexpr std::uint64_t of_model = ~std::uint64_t{0};

/// Returns sine and cosine of an angle [rad] in x and z, the same on all machines.
glm::dvec3 circle(double angle)
{
    return unit_vector({.azimuth = static_cast<float>(angle)});
}

/// Returns a uniformly distributed rotation [Shoemake 1992, "Uniform random rotations"].
DMat3 drawn_rotation(ModelDraw& draw)
{
    const double u = draw.next();
    const glm::dvec3 v = circle(2.0 * std::numbers::pi * draw.next());
    const glm::dvec3 w = circle(2.0 * std::numbers::pi * draw.next());
    const double x = std::sqrt(1.0 - u) * v.x;
    const double y = std::sqrt(1.0 - u) * v.z;
    const double z = std::sqrt(u) * w.x;
    const double r = std::sqrt(u) * w.z;
    return {1 - 2 * (y * y + z * z), 2 * (x * y + r * z),     2 * (x * z - r * y),
            2 * (x * y - r * z),     1 - 2 * (x * x + z * z), 2 * (y * z + r * x),
            2 * (x * z + r * y),     2 * (y * z - r * x),     1 - 2 * (x * x + y * y)};
}

glm::dvec3 on_sphere(double height, double azimuth)
{
    const double radius = std::sqrt(std::max(1.0 - height * height, 0.0));
    const glm::dvec3 around = circle(azimuth);
    return glm::normalize(glm::dvec3(radius * around.x, height, radius * around.z));
}

/// Returns the sine of an elevation [rad].
double height_of(double elevation)
{
    return static_cast<double>(unit_vector({.elevation = static_cast<float>(elevation)}).y);
}

/// Returns point `index` of a spherical Fibonacci lattice of `count`.
glm::dvec3 lattice_point(std::int64_t index, std::int64_t count)
{
    const double turns = static_cast<double>(index) / std::numbers::phi;
    const double height =
        1.0 - (2.0 * static_cast<double>(index) + 1.0) / static_cast<double>(count);
    return on_sphere(height, 2.0 * std::numbers::pi * (turns - std::floor(turns)));
}

/// Returns the pose of a camera at `eye` that looks along `-backward`, with the horizon level.
Mat4 level_pose(const glm::dvec3& eye, const glm::dvec3& backward)
{
    constexpr double vertical = 1.0 - 1e-9;
    const glm::dvec3 up = std::abs(backward.y) > vertical
                              ? glm::dvec3(0.0, 0.0, backward.y > 0.0 ? -1.0 : 1.0)
                              : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, backward));
    return Mat4(DMat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(backward, right), 0.0),
                      glm::dvec4(backward, 0.0), glm::dvec4(eye, 1.0)));
}

/// Returns the distance at which a sphere of `radius` just fits into the image.
double fitting_distance(double radius, const CameraDesc& camera, const Size& size)
{
    const double smaller = 0.5 * std::min(size.width, size.height);
    const double slope = smaller / intrinsics(camera, size.width, size.height).fy;
    return radius * std::sqrt(1.0 + slope * slope) / slope;
}

ordered_json matrix_json(const DMat4& matrix)
{
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 4; ++row) {
        const glm::dvec4 values = glm::row(matrix, row);
        rows.push_back({values.x, values.y, values.z, values.w});
    }
    return rows;
}

/// Returns the pose of a camera in the coordinates of the file, without scale.
DMat4 pose_in_file(const CameraDesc& camera, const DVec3& origin)
{
    DMat4 pose(camera.world_from_camera);
    for (int axis = 0; axis < 3; ++axis) {
        pose[axis] = glm::dvec4(glm::normalize(glm::dvec3(pose[axis])), 0.0);
    }
    pose[3] += glm::dvec4(origin, 0.0);
    return pose;
}

/// Returns the matrix from world to camera with OpenCV's axes: x right, y down, z forward.
DMat4 opencv_matrix(const DMat4& world_from_camera)
{
    const DMat4 flip(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, -1, 0, 0), glm::dvec4(0, 0, -1, 0),
                     glm::dvec4(0, 0, 0, 1));
    return flip * glm::inverse(world_from_camera);
}

/// Returns how images are projected, as members of a file of poses.
ordered_json projection_json(const PosedCamera& view)
{
    ordered_json json{{"w", view.size.width}, {"h", view.size.height}};
    if (view.camera.projection == Projection::orthographic) {
        json["camera_model"] = "ORTHOGRAPHIC";
        json["vertical_extent"] = view.camera.vertical_extent;
        return json;
    }
    const Intrinsics values = intrinsics(view.camera, view.size.width, view.size.height);
    json["camera_model"] = "PINHOLE";
    json["fl_x"] = values.fx;
    json["fl_y"] = values.fy;
    json["cx"] = values.cx;
    json["cy"] = values.cy;
    json["camera_angle_x"] = angle_of_view(values.fx, view.size.width);
    json["camera_angle_y"] = angle_of_view(values.fy, view.size.height);
    return json;
}

Mat4 read_pose(const io::JsonValue& json, const DVec3& origin)
{
    DMat4 pose(1.0);
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            pose[static_cast<int>(column)][static_cast<int>(row)] =
                json.at(row).at(column).number<double>();
        }
    }
    constexpr double tolerance = 1e-3;
    const DMat3 rotation(pose);
    const DMat3 square = glm::transpose(rotation) * rotation;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (std::abs(square[i][k] - (i == k ? 1.0 : 0.0)) > tolerance) {
                json.fail("is no rigid motion: its axes are not orthogonal and of length 1");
            }
        }
    }
    if (glm::determinant(rotation) < 0.0) {
        json.fail("is no rigid motion: it mirrors");
    }
    const glm::dvec4 last = glm::row(pose, 3);
    if (last != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
        json.fail("is no rigid motion: its last row is not 0, 0, 0, 1");
    }
    pose[3] -= glm::dvec4(origin, 0.0);
    return Mat4(pose);
}

constexpr double max_pixels = 1e9;  // of a focal length or a principal point

/// A document of poses: members of a frame replace those of the whole.
struct PoseFile {
    const io::JsonValue& whole;
    const io::JsonValue& frame;

    [[nodiscard]] std::optional<io::JsonValue> find(std::string_view key) const
    {
        return frame.has(key)   ? std::optional(frame.at(key))
               : whole.has(key) ? std::optional(whole.at(key))
                                : std::nullopt;
    }
    [[nodiscard]] std::optional<double> number(std::string_view key, double low, double high) const
    {
        const std::optional<io::JsonValue> value = find(key);
        return value ? std::optional(value->number<double>(low, high)) : std::nullopt;
    }
};

PosedCamera read_frame(const PoseFile& poses, const std::optional<Size>& size, const DVec3& origin)
{
    constexpr double most_pixels = 65535.0;
    constexpr Size default_image{512, 512};
    const auto width = poses.number("w", 1.0, most_pixels);
    const auto height = poses.number("h", 1.0, most_pixels);
    Size stated = size.value_or(default_image);
    if (width && height) {
        stated = {static_cast<int>(*width), static_cast<int>(*height)};
    }
    PosedCamera result;
    result.size = size.value_or(stated);
    if (std::int64_t{result.size.width} * stated.height !=
        std::int64_t{result.size.height} * stated.width) {
        poses.frame.fail(fmt::format("its image has {}x{} pixels; --size {}x{} has another shape",
                                     stated.width, stated.height, result.size.width,
                                     result.size.height));
    }
    result.camera.world_from_camera = read_pose(poses.frame.at("transform_matrix"), origin);
    if (const auto model = poses.find("camera_model"); model && model->text() == "ORTHOGRAPHIC") {
        result.camera.projection = Projection::orthographic;
        result.camera.vertical_extent =
            static_cast<float>(poses.frame.has("vertical_extent")
                                   ? poses.frame.at("vertical_extent").number<double>(1e-12, 1e12)
                                   : poses.whole.at("vertical_extent").number<double>(1e-12, 1e12));
        return result;
    }
    constexpr double widest = std::numbers::pi - 1e-3;
    constexpr double narrowest = 1e-6;
    auto fx = poses.number("fl_x", narrowest, max_pixels);
    auto fy = poses.number("fl_y", narrowest, max_pixels);
    if (const auto angle = poses.number("camera_angle_x", narrowest, widest); angle && !fx) {
        fx = focal_length(*angle, stated.width);
    }
    if (const auto angle = poses.number("camera_angle_y", narrowest, widest); angle && !fy) {
        fy = focal_length(*angle, stated.height);
    }
    if (!fx && !fy) {
        poses.whole.fail("has no fl_x and no camera_angle_x");
    }
    set_intrinsics(
        result.camera,
        {.fx = fx ? *fx : *fy,
         .fy = fy ? *fy : *fx,
         .cx = poses.number("cx", -max_pixels, max_pixels).value_or(0.5 * stated.width),
         .cy = poses.number("cy", -max_pixels, max_pixels).value_or(0.5 * stated.height)},
        stated.width, stated.height);
    return result;
}

}  // namespace

ModelDraw::ModelDraw(std::uint64_t seed, std::string_view model, std::uint64_t view)
{
    ContentHasher hasher;
    hasher.add(&seed, sizeof(seed));
    hasher.add(&view, sizeof(view));
    hasher.add(model.data(), model.size());
    key_ = hasher.hash().low;
}

double ModelDraw::next()
{
    constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;
    ++count_;
    return static_cast<double>(mixed(key_ + count_ * step) >> 11) * 0x1p-53;
}

double ModelDraw::next(const NumberRange& interval)
{
    return interval.low + (interval.high - interval.low) * next();
}

const std::filesystem::path& drawn_environment(std::span<const std::filesystem::path> environments,
                                               std::uint64_t seed, std::string_view model)
{
    ModelDraw draw(seed, model, of_model);
    const double share = draw.next() * static_cast<double>(environments.size());
    return environments[static_cast<std::size_t>(share)];
}

std::vector<CameraDesc> drawn_cameras(const ViewDraw& draw, const CameraDesc& camera, Vec3 min,
                                      Vec3 max, const Size& size, std::uint64_t seed,
                                      std::string_view model)
{
    const glm::dvec3 middle = 0.5 * (glm::dvec3(min) + glm::dvec3(max));
    const double radius = std::max(0.5 * glm::length(glm::dvec3(max) - glm::dvec3(min)), 1e-6);
    ModelDraw of_all(seed, model, of_model);
    static_cast<void>(of_all.next());  // the environment's
    const DMat3 rotation = drawn_rotation(of_all);
    std::vector<CameraDesc> cameras;
    for (std::int64_t i = 0; i < draw.count; ++i) {
        ModelDraw of_view(seed, model, static_cast<std::uint64_t>(i));
        CameraDesc& drawn = cameras.emplace_back(camera);
        if (draw.vertical_fov) {
            drawn.vertical_fov = static_cast<float>(of_view.next(*draw.vertical_fov));
        }
        glm::dvec3 direction = rotation * lattice_point(i, draw.count);
        if (draw.range) {
            const double azimuth = of_view.next(draw.range->azimuth);
            const double height = of_view.next(
                {height_of(draw.range->elevation.low), height_of(draw.range->elevation.high)});
            direction = on_sphere(height, azimuth);
        }
        const double distance = of_view.next(draw.distance) * fitting_distance(radius, drawn, size);
        drawn.world_from_camera = level_pose(middle + distance * direction, direction);
    }
    return cameras;
}

std::string poses_text(std::span<const PoseRecord> records, const DVec3& origin)
{
    ordered_json json = ordered_json::object();
    const auto have_equal = [&](const ordered_json& projection) {
        return std::all_of(records.begin(), records.end(), [&](const PoseRecord& record) {
            return projection_json(record.view) == projection;
        });
    };
    const ordered_json first =
        records.empty() ? ordered_json::object() : projection_json(records.front().view);
    const bool is_shared = have_equal(first);
    if (is_shared) {
        json.update(first);
    }
    const bool has_depth =
        std::any_of(records.begin(), records.end(),
                    [](const PoseRecord& record) { return record.depth.has_value(); });
    if (has_depth) {
        json["depth_unit_scale_factor"] = 0.001;
    }
    std::string frames;  // each in a line
    for (const PoseRecord& record : records) {
        const DMat4 pose = pose_in_file(record.view.camera, origin);
        ordered_json frame{{"file_path", record.file}};
        if (record.depth) {
            frame["depth_file_path"] = *record.depth;
        }
        if (record.mask) {
            frame["mask_path"] = *record.mask;
        }
        if (record.time) {
            frame["time"] = *record.time;
        }
        if (!is_shared) {
            frame.update(projection_json(record.view));
        }
        frame["transform_matrix"] = matrix_json(pose);
        frame["opencv"] = matrix_json(opencv_matrix(pose));
        frames += (frames.empty() ? "\n" : ",\n") +
                  frame.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    }
    std::string text = json.dump();
    text.pop_back();
    return text + (json.empty() ? "" : ",\n") + "\"frames\": [" + frames + "\n]}\n";
}

std::vector<PosedCamera> read_poses(const std::filesystem::path& file,
                                    const std::optional<Size>& size, const DVec3& origin)
{
    const io::JsonValue whole = io::JsonValue::read(file);
    const std::vector<io::JsonValue> frames = whole.at("frames").elements();
    if (frames.empty()) {
        whole.at("frames").fail("is empty");
    }
    std::vector<PosedCamera> views;
    views.reserve(frames.size());
    for (const io::JsonValue& frame : frames) {
        views.push_back(read_frame({whole, frame}, size, origin));
    }
    return views;
}

}  // namespace bdpt::job
