#include <bdpt/tools/intrinsics.h>
#include <bdpt/tools/scene_builder.h>
#include <fmt/core.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "options/groups/view_arguments.h"
#include "python_parts.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double rigid_tolerance = 1e-4;

using ThreeDoubles = std::array<double, 3>;

/// Throws unless `number` is finite and within (low, high), or [low, high).
void check(const char* name, double number, bool is_within, const char* expected)
{
    if (!std::isfinite(number) || !is_within) {
        throw ValueError(fmt::format("{}={}: expected {}", name, number, expected));
    }
}

float to_fov(double fov)
{
    check("fov", fov, fov > 0.0 && fov < 180.0, "degrees above 0 and below 180");
    return static_cast<float>(fov / degrees);
}

/// The lens of a camera.
void set_lens(CameraDesc& camera, double lens_radius, double focus_distance)
{
    check("lens_radius", lens_radius, lens_radius >= 0.0, "a number of at least 0");
    check("focus_distance", focus_distance, focus_distance > 0.0, "a number above 0");
    camera.lens_radius = static_cast<float>(lens_radius);
    camera.focus_distance = static_cast<float>(focus_distance);
}

PythonCamera make_camera(const ThreeDoubles& from, const ThreeDoubles& look_at, double fov,
                         double lens_radius, const std::optional<double>& focus_distance)
{
    const DVec3 eye(from[0], from[1], from[2]);
    const DVec3 goal(look_at[0], look_at[1], look_at[2]);
    for (int axis = 0; axis < 3; ++axis) {
        check("from_", eye[axis], true, "finite numbers");
        check("look_at", goal[axis], true, "finite numbers");
    }
    constexpr double far = 1e4;  // where single precision has steps of a millimetre
    PythonCamera camera;
    camera.origin = glm::length(eye) > far ? eye : DVec3(0.0);
    const float angle = to_fov(fov);
    camera.desc = job::apply({.from = eye, .look_at = goal, .vertical_fov = angle}, CameraDesc{},
                             std::nullopt, camera.origin);
    const Vec3 line = job::to_world(goal, camera.origin) - job::to_world(eye, camera.origin);
    set_lens(camera.desc, lens_radius,
             focus_distance.value_or(static_cast<double>(glm::length(line))));
    return camera;
}

/// Throws unless the matrix is a rigid motion.
void check_rigid(const DMat4& pose)
{
    const glm::dmat3 rotation(pose);
    for (int column = 0; column < 4; ++column) {
        if (std::abs(pose[column][3] - (column == 3 ? 1.0 : 0.0)) > rigid_tolerance) {
            throw ValueError(
                "pose: the last row of the matrix is not (0, 0, 0, 1): is it "
                "transposed?");
        }
    }
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(product[i][i] - 1.0) > rigid_tolerance) {
            throw ValueError(
                fmt::format("pose: not a rotation: column {} has the length {:.6g}, "
                            "not 1",
                            i, std::sqrt(product[i][i])));
        }
        for (int j = 0; j < i; ++j) {
            if (std::abs(product[i][j]) > rigid_tolerance) {
                throw ValueError(fmt::format(
                    "pose: not a rotation: columns {} and {} are not perpendicular (cosine {:.6g})",
                    j, i, product[i][j]));
            }
        }
    }
    if (glm::determinant(rotation) < 0.0) {
        throw ValueError("pose: not a rotation: it mirrors (its determinant is -1)");
    }
}

using IntPair = std::pair<int, int>;

PythonCamera from_matrix(const nb::object& pose, const std::optional<double>& fov,
                         const std::optional<double>& fx, const std::optional<double>& fy,
                         const std::optional<double>& cx, const std::optional<double>& cy,
                         const std::optional<IntPair>& size, const std::string& convention,
                         const std::optional<double>& vertical_extent, double lens_radius,
                         double focus_distance)
{
    const std::vector<DMat4> poses = to_matrices(pose, "pose");
    if (poses.size() != 1) {
        throw ValueError(fmt::format("pose: expected one matrix, not {}", poses.size()));
    }
    DMat4 matrix = poses.front();
    check_rigid(matrix);
    if (convention == "opencv") {
        matrix[1] = -matrix[1];
        matrix[2] = -matrix[2];
    } else if (convention != "opengl") {
        throw ValueError(fmt::format("convention='{}': expected opengl or opencv", convention));
    }
    const bool has_focal_length = fx || fy;
    if ((fov ? 1 : 0) + (has_focal_length ? 1 : 0) + (vertical_extent ? 1 : 0) != 1) {
        throw CallError("from_matrix() takes one of fov, fx with fy, and vertical_extent");
    }
    if (!size && (has_focal_length || cx || cy)) {
        throw CallError("from_matrix() needs size for fx, fy, cx and cy, which are in pixels");
    }
    PythonCamera camera;
    camera.origin = DVec3(matrix[3]);
    matrix[3] = {0.0, 0.0, 0.0, 1.0};
    CameraDesc& desc = camera.desc;
    desc.world_from_camera = Mat4(matrix);
    set_lens(desc, lens_radius, focus_distance);
    if (size) {
        check_size(*size);
        camera.size = job::Size{size->first, size->second};
        const double width = size->first;
        const double height = size->second;
        desc.aspect_ratio = static_cast<float>(width / height);
        desc.shift = {static_cast<float>(0.5 - cx.value_or(0.5 * width) / width),
                      static_cast<float>(cy.value_or(0.5 * height) / height - 0.5)};
    }
    if (fov) {
        desc.vertical_fov = to_fov(*fov);
    } else if (vertical_extent) {
        check("vertical_extent", *vertical_extent, *vertical_extent > 0.0, "a number above 0");
        desc.projection = Projection::orthographic;
        desc.vertical_extent = static_cast<float>(*vertical_extent);
    } else {
        const double x = fx.value_or(fy.value_or(0.0));
        const double y = fy.value_or(x);
        check("fx", x, x > 0.0, "a number above 0");
        check("fy", y, y > 0.0, "a number above 0");
        desc.vertical_fov = static_cast<float>(angle_of_view(y, size->second));
        desc.pixel_aspect = static_cast<float>(y / x);
    }
    for_each_field(desc, [](const auto& field, const auto& value) {
        if constexpr (requires { field.limits; }) {
            check_number(field, value, std::string(field.name));
        }
    });
    return camera;
}

nb::object intrinsics(const PythonCamera& camera, const std::optional<IntPair>& asked)
{
    if (!asked && !camera.size) {
        throw CallError("intrinsics() needs size: the camera has none of its own");
    }
    const job::Size size = asked ? job::Size{asked->first, asked->second} : *camera.size;
    check_size({size.width, size.height});
    const CameraDesc& desc = camera.desc;
    Intrinsics values = bdpt::intrinsics(desc, size.width, size.height);
    if (desc.projection == Projection::orthographic) {
        values.fy = size.height / static_cast<double>(desc.vertical_extent);
        values.fx = values.fy / static_cast<double>(desc.pixel_aspect);
    }
    return to_numpy<double>({values.fx, 0.0, values.cx, 0.0, values.fy, values.cy, 0.0, 0.0, 1.0},
                            {3, 3});
}

std::string camera_text(const PythonCamera& camera)
{
    const CameraDesc& desc = camera.desc;
    const DMat4 pose = in_file(desc.world_from_camera, camera.origin);
    const Vec3 eye(desc.world_from_camera[3]);
    const Vec3 goal = eye - Vec3(desc.world_from_camera[2]) * desc.focus_distance;
    const Mat4 upright = look_at(eye, goal).world_from_camera;
    bool is_upright = desc.projection == Projection::perspective && desc.shift == Vec2(0.0f) &&
                      desc.pixel_aspect == 1.0f;
    for (int i = 0; i < 3; ++i) {
        constexpr float step = 1e-4f;
        is_upright = is_upright && glm::distance(upright[i], desc.world_from_camera[i]) < step;
    }
    std::string lens = desc.projection == Projection::perspective
                           ? fmt::format("fov={:.6g}", desc.vertical_fov * degrees)
                           : fmt::format("vertical_extent={:.6g}", desc.vertical_extent);
    if (desc.shift != Vec2(0.0f) || desc.pixel_aspect != 1.0f) {
        lens += fmt::format(", shift=({:.6g}, {:.6g}), pixel_aspect={:.6g}", desc.shift.x,
                            desc.shift.y, desc.pixel_aspect);
    }
    if (camera.size) {
        lens += fmt::format(", size=({}, {})", camera.size->width, camera.size->height);
        is_upright = false;
    }
    if (desc.lens_radius > 0.0f) {
        lens += fmt::format(", lens_radius={:.6g}", desc.lens_radius);
    }
    const DVec3 target = job::to_file(goal, camera.origin);
    return is_upright
               ? fmt::format(
                     "Camera(from_=({:.6g}, {:.6g}, {:.6g}), look_at=({:.6g}, {:.6g}, {:.6g}), {})",
                     pose[3].x, pose[3].y, pose[3].z, target.x, target.y, target.z, lens)
               : fmt::format("Camera.from_matrix(<float64 (4, 4)>, {})", lens);
}

/// Pose in rows, numbers of the lens, size (0: none), and name.
using CameraState =
    std::tuple<std::array<double, 16>, std::array<float, 7>, bool, IntPair, std::string>;

CameraState get_camera_state(const PythonCamera& camera)
{
    const CameraDesc& desc = camera.desc;
    if (!desc.motion.empty()) {
        throw nb::type_error("a camera that moves cannot be pickled");
    }
    const DMat4 pose = glm::transpose(in_file(desc.world_from_camera, camera.origin));
    std::array<double, 16> rows{};
    std::copy_n(glm::value_ptr(pose), rows.size(), rows.begin());
    const job::Size size = camera.size.value_or(job::Size{});
    return {rows,
            {desc.vertical_fov, desc.vertical_extent, desc.shift.x, desc.shift.y, desc.pixel_aspect,
             desc.lens_radius, desc.focus_distance},
            desc.projection == Projection::perspective,
            {size.width, size.height},
            desc.name};
}

PythonCamera load_camera_state(const CameraState& state)
{
    const auto& [rows, lens, is_perspective, size, name] = state;
    DMat4 pose = glm::transpose(glm::make_mat4(rows.data()));
    PythonCamera camera;
    camera.origin = DVec3(pose[3]);
    pose[3] = {0.0, 0.0, 0.0, 1.0};
    camera.desc = {
        .name = name,
        .world_from_camera = Mat4(pose),
        .projection = is_perspective ? Projection::perspective : Projection::orthographic,
        .vertical_fov = lens[0],
        .vertical_extent = lens[1],
        .shift = {lens[2], lens[3]},
        .pixel_aspect = lens[4],
        .lens_radius = lens[5],
        .focus_distance = lens[6]};
    if (size.first > 0) {
        camera.size = job::Size{size.first, size.second};
        camera.desc.aspect_ratio = static_cast<float>(size.first) / static_cast<float>(size.second);
    }
    return camera;
}

constexpr const char* from_matrix_text =
    "A camera at a pose.\n\n"
    "pose: the 4 x 4 matrix from the camera to the world [m], an array or nested lists: a rotation "
    "(orthonormal within 1e-4, not mirrored) and a place. From world to camera, as OpenCV has "
    "extrinsics, invert it: numpy.linalg.inv(matrix).\n"
    "convention: axes of the camera. 'opengl': x right, y up, looks along -z, as in Blender, "
    "glTF and NeRF; 'opencv': x right, y down, looks along +z, as in COLMAP.\n"
    "One of: fov, the vertical field of view [degrees]; fx and fy, focal lengths [pixels of size], "
    "one of which is enough for square pixels; vertical_extent, the height of the view of an "
    "orthographic camera [m].\n"
    "cx, cy: place of the camera's axis in the image [pixels of size] from the top left corner; "
    "the middle of pixel (i, j) is at (i + 0.5, j + 0.5). Default: the middle of the image. "
    "Add 0.5 to values of programs whose pixel middles are whole numbers.\n"
    "size: width and height [pixels]: also the size of renders that state none.\n"
    "lens_radius, focus_distance: those of a thin lens [m].\n\n"
    "Raises ValueError for a pose that is not a rigid motion (the message says why) and for values "
    "out of range; TypeError without one of the three, and for pixels without size.";

}  // namespace

void check_size(const std::pair<int, int>& size)
{
    if (size.first < 1 || size.second < 1) {
        throw ValueError(fmt::format("size=({}, {}): expected one pixel a side or more", size.first,
                                     size.second));
    }
}

CameraDesc PythonCamera::in_world(const DVec3& other) const
{
    CameraDesc moved = desc;
    const auto move = [&](Mat4& matrix) {
        matrix[3] = Vec4(job::to_world(job::to_file(Vec3(matrix[3]), origin), other), 1.0f);
    };
    move(moved.world_from_camera);
    for (Mat4& matrix : moved.motion) {
        move(matrix);
    }
    return moved;
}

DoubleInput to_doubles(nb::handle value, const std::string& name)
{
    try {
        const nb::module_ numpy = nb::module_::import_("numpy");
        return nb::cast<DoubleInput>(
            numpy.attr("ascontiguousarray")(value, nb::arg("dtype") = numpy.attr("float64")));
    } catch (const nb::python_error&) {
        throw CallError(fmt::format("{}={}: expected an array of numbers", name, written(value)));
    }
}

std::vector<DMat4> to_matrices(nb::handle value, const std::string& name)
{
    const DoubleInput array = to_doubles(value, name);
    const std::size_t n = array.ndim();
    if ((n != 2 && n != 3) || array.shape(n - 1) != 4 || array.shape(n - 2) != 4) {
        const nb::object shape = nb::module_::import_("numpy").attr("shape")(value);
        throw ValueError(fmt::format("{}: expected a matrix of shape (4, 4), not {}", name,
                                     nb::cast<std::string>(nb::repr(shape))));
    }
    std::vector<DMat4> matrices(n == 2 ? 1 : array.shape(0));
    const double* number = array.data();
    for (DMat4& matrix : matrices) {
        matrix = glm::transpose(glm::make_mat4(number));
        for (const double* const end = number + 16; number != end; ++number) {
            if (!std::isfinite(*number)) {
                throw ValueError(fmt::format("{}: {} is not a finite number", name, *number));
            }
        }
    }
    return matrices;
}

nb::object to_numpy(const DMat4& matrix)
{
    const DMat4 rows = glm::transpose(matrix);
    const double* const first = glm::value_ptr(rows);
    return to_numpy<double>({first, first + 16}, {4, 4});
}

DMat4 in_file(const Mat4& matrix, const DVec3& origin)
{
    DMat4 result(matrix);
    result[3] += glm::dvec4(origin, 0.0);
    return result;
}

void bind_camera(nb::module_& module)
{
    using Camera = PythonCamera;
    const auto of_perspective = [](const Camera& camera) {
        return camera.desc.projection == Projection::perspective;
    };
    nb::class_<Camera>(module, "Camera",
                       "A camera; +y is up. Its values cannot be changed. Coordinates are those of "
                       "the file.")
        .def(
            "__init__",
            [](Camera* self, const ThreeDoubles& from, const ThreeDoubles& look_at, double fov,
               double lens_radius, const std::optional<double>& focus_distance) {
                new (self) Camera(make_camera(from, look_at, fov, lens_radius, focus_distance));
            },
            nb::arg("from_"), nb::arg("look_at"), nb::arg("fov") = 45.0,
            nb::arg("lens_radius") = 0.0, nb::arg("focus_distance") = nb::none(),
            "Position and target [m], vertical field of view [degrees], radius of a thin lens "
            "[m], focus distance [m] (default: that of the target).")
        .def_static("from_matrix", &from_matrix, nb::arg("pose"), nb::kw_only(),
                    nb::arg("fov") = nb::none(), nb::arg("fx") = nb::none(),
                    nb::arg("fy") = nb::none(), nb::arg("cx") = nb::none(),
                    nb::arg("cy") = nb::none(), nb::arg("size") = nb::none(),
                    nb::arg("convention") = "opengl", nb::arg("vertical_extent") = nb::none(),
                    nb::arg("lens_radius") = 0.0, nb::arg("focus_distance") = 1.0,
                    nb::sig("def from_matrix(pose: numpy.typing.ArrayLike, *, fov: float | None = "
                            "None, fx: float | None = None, fy: float | None = None, cx: float | "
                            "None = None, cy: float | None = None, size: tuple[int, int] | None = "
                            "None, convention: typing.Literal['opengl', 'opencv'] = 'opengl', "
                            "vertical_extent: float | None = None, lens_radius: float = 0.0, "
                            "focus_distance: float = 1.0) -> Camera"),
                    from_matrix_text)
        .def_prop_ro(
            "matrix",
            [](const Camera& camera) {
                return to_numpy(in_file(camera.desc.world_from_camera, camera.origin));
            },
            nb::sig("def matrix(self) -> numpy.typing.NDArray[numpy.float64]"),
            "4 x 4 matrix from the camera to the world [m], of the axes 'opengl': x right, y up, "
            "looks along -z. For those of OpenCV: matrix @ numpy.diag([1, -1, -1, 1]).")
        .def("intrinsics", &intrinsics, nb::arg("size") = nb::none(),
             nb::sig("def intrinsics(self, size: tuple[int, int] | None = None) -> "
                     "numpy.typing.NDArray[numpy.float64]"),
             "3 x 3 matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] for an image of size (default: "
             "that of the camera) [pixels], for the axes of OpenCV: (x / z, y / z, 1) to pixels "
             "from the top left corner, whose middles are at 0.5. Of an orthographic camera: (x, "
             "y, 1) to pixels.")
        .def_prop_ro(
            "size",
            [](const Camera& camera) -> std::optional<IntPair> {
                return camera.size ? std::optional(IntPair(camera.size->width, camera.size->height))
                                   : std::nullopt;
            },
            "Width and height of its image [pixels], if they were stated.")
        .def_prop_ro(
            "fov",
            [of_perspective](const Camera& camera) {
                return of_perspective(camera)
                           ? std::optional(static_cast<double>(camera.desc.vertical_fov) * degrees)
                           : std::nullopt;
            },
            "Vertical field of view [degrees]; None: orthographic.")
        .def_prop_ro(
            "vertical_extent",
            [of_perspective](const Camera& camera) {
                return of_perspective(camera) ? std::nullopt
                                              : std::optional(camera.desc.vertical_extent);
            },
            "Height of the view of an orthographic camera [m]; None: perspective.")
        .def_prop_ro(
            "name", [](const Camera& camera) { return camera.desc.name; }, "Its name in the file.")
        .def_prop_ro(
            "lens_radius", [](const Camera& camera) { return camera.desc.lens_radius; },
            "Radius of a thin lens [m]; 0: a pinhole.")
        .def_prop_ro(
            "focus_distance", [](const Camera& camera) { return camera.desc.focus_distance; },
            "Distance of the plane in focus of a thin lens [m].")
        .def("__getstate__", &get_camera_state)
        .def("__setstate__",
             [](Camera& self, const CameraState& state) {
                 new (&self) Camera(load_camera_state(state));
             })
        .def("__repr__", &camera_text);
}

}  // namespace bdpt::python
