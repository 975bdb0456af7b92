#include "options/groups/view_arguments.h"

#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/thin_lens.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "messages/text.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

std::string list_cameras(std::span<const CameraDesc> cameras)
{
    constexpr std::size_t max_listed = 8;
    std::string result;
    for (std::size_t i = 0; i < std::min(cameras.size(), max_listed); ++i) {
        const std::string& name = cameras[i].name;
        result += fmt::format("{}{}{}", i == 0 ? "" : ", ", i,
                              name.empty() ? "" : fmt::format(" \"{}\"", name));
    }
    return result + (cameras.size() > max_listed ? ", ..." : "");
}

/// Returns camera axes that look from `eye` to `target`, upright where that is defined.
Mat4 look_at(Vec3 eye, Vec3 target)
{
    // Closer to the vertical, +y is no longer up in the image; then -z is.
    constexpr float vertical = 0.9999f;
    const Vec3 forward = glm::normalize(target - eye);
    const Vec3 up =
        std::abs(forward.y) < vertical ? Vec3(0.0f, 1.0f, 0.0f) : Vec3(0.0f, 0.0f, -1.0f);
    const Vec3 right = glm::normalize(glm::cross(forward, up));
    return Mat4(Vec4(right, 0.0f), Vec4(glm::cross(right, forward), 0.0f), Vec4(-forward, 0.0f),
                Vec4(eye, 1.0f));
}

}  // namespace

const CameraDesc& select_camera(std::span<const CameraDesc> cameras,
                                const std::string& name_or_index, const std::string& file)
{
    const auto named = std::find_if(cameras.begin(), cameras.end(), [&](const CameraDesc& camera) {
        return camera.name == name_or_index;
    });
    if (named != cameras.end()) {
        return *named;
    }
    const std::optional<std::size_t> index = parse_index(name_or_index);
    if (index && *index < cameras.size()) {
        return cameras[*index];
    }
    const std::string what = fmt::format("{}: no camera \"{}\"", file, name_or_index);
    throw UnknownName(
        cameras.empty()
            ? fmt::format("{}; the scene has none (--camera auto frames it)", what)
            : fmt::format("{}; this scene has {}: {}", what,
                          cameras.size() == 1 ? "one camera" : counted(cameras.size(), "camera"),
                          list_cameras(cameras)));
}

std::string place_text(Vec3 point, const DVec3& origin, int digits)
{
    constexpr int many = 9;
    const DVec3 place = to_file(point, origin);
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        text += fmt::format("{}{:.{}g}", axis == 0 ? "" : ",", place[axis],
                            origin[axis] == 0.0 ? digits : many);
    }
    return text;
}

CameraDesc apply(const ViewOverrides& overrides, const CameraDesc& camera,
                 const std::optional<Vec3>& target, const DVec3& origin)
{
    if (overrides.vertical_fov && camera.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} is orthographic: --fov needs a perspective camera",
                                camera.name));
    }
    CameraDesc result = camera;
    result.vertical_fov = overrides.vertical_fov.value_or(camera.vertical_fov);
    if (!overrides.from && !overrides.look_at) {
        return result;
    }
    result.motion.clear();  // The user fixes the position.
    const Vec3 eye =
        overrides.from ? to_world(*overrides.from, origin) : Vec3(camera.world_from_camera[3]);
    const std::optional<Vec3> goal =
        overrides.look_at ? to_world(*overrides.look_at, origin) : target;
    if (!goal) {
        result.world_from_camera[3] = Vec4(eye, 1.0f);
        return result;
    }
    const Vec3 forward = *goal - eye;
    if (!(glm::dot(forward, forward) > 0.0f)) {
        const Vec3 place(to_file(eye, origin));
        throw Error(ErrorCode::usage,
                    fmt::format("the camera at {},{},{} cannot look at its own position: --from "
                                "and --look-at must differ",
                                place.x, place.y, place.z));
    }
    result.world_from_camera = look_at(eye, *goal);
    return result;
}

Size default_size(const std::optional<float>& aspect_ratio)
{
    constexpr Size box{1280, 720};
    constexpr float box_aspect = 1280.0f / 720.0f;
    const float aspect = aspect_ratio.value_or(box_aspect);
    if (!(aspect > 0.0f) || !std::isfinite(aspect)) {
        return box;
    }
    // Clamped before the conversion, as a ratio of 1e30 exceeds an int.
    if (aspect >= box_aspect) {
        const float height = std::max(1.0f, std::round(static_cast<float>(box.width) / aspect));
        return {box.width, static_cast<int>(height)};
    }
    const float width = std::max(1.0f, std::round(static_cast<float>(box.height) * aspect));
    return {static_cast<int>(width), box.height};
}

namespace {

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180.0;
}

ValueType<float> field_of_view()
{
    const auto parse = [](const std::string& text) -> std::optional<float> {
        const std::optional<double> degrees = parse_number<double>(text);
        if (!degrees || !(*degrees > 0.0 && *degrees < 180.0)) {
            return std::nullopt;
        }
        return static_cast<float>(radians(*degrees));
    };
    return {.parse = parse,
            .expected = "degrees between 0 and 180",
            .info = {.json = JsonType::number, .range = {.low = 0, .low_is_excluded = true}}};
}

/// Accepts a focal length in millimetres, as the vertical field of view.
ValueType<float> focal_length()
{
    return converted(number(1.0, 10'000.0, "millimetres from 1 to 10000"), [](double length) {
        return static_cast<float>(compute_vertical_fov(1e-3 * length));
    });
}

ValueType<ViewDirection> view_direction()
{
    constexpr float quarter = std::numbers::pi_v<float> / 2.0f;
    const Choices<ViewDirection> named{{{"front", {0.0f, 0.0f}},
                                        {"right", {quarter, 0.0f}},
                                        {"back", {2.0f * quarter, 0.0f}},
                                        {"left", {-quarter, 0.0f}},
                                        {"top", {0.0f, quarter}},
                                        {"bottom", {0.0f, -quarter}},
                                        {"three-quarter", three_quarter_view}}};
    const auto parse = [named](const std::string& given) -> std::optional<ViewDirection> {
        const std::string text = lower_case(given);
        if (const auto direction = named.type().parse(text)) {
            return direction;
        }
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos) {
            return std::nullopt;
        }
        const auto azimuth = parse_number<double>(text.substr(0, comma));
        const auto elevation = parse_number<double>(text.substr(comma + 1));
        if (!azimuth || !elevation || !(std::abs(*azimuth) <= 360.0) ||
            !(std::abs(*elevation) <= 90.0)) {
            return std::nullopt;
        }
        return ViewDirection{.azimuth = static_cast<float>(radians(*azimuth)),
                             .elevation = static_cast<float>(radians(*elevation))};
    };
    return {.parse = parse,
            .expected =
                "front, right, back, left, top, bottom, three-quarter, or AZIMUTH,ELEVATION "
                "in degrees with an azimuth from -360 to 360 and an elevation from -90 to 90",
            .info = {}};
}

ValueType<float> margin()
{
    constexpr double widest = 45.0;
    const auto parse = [](const std::string& text) -> std::optional<float> {
        const std::optional<double> percent =
            parse_number<double>(text.ends_with('%') ? text.substr(0, text.size() - 1) : text);
        if (!percent || !(*percent >= 0.0 && *percent <= widest)) {
            return std::nullopt;
        }
        return static_cast<float>(*percent / 100.0);
    };
    return {.parse = parse, .expected = "percent from 0 to 45, like 10%", .info = {}};
}

}  // namespace

void add_camera_options(OptionList& options, std::optional<std::string>& camera,
                        ViewOverrides& view)
{
    options.add("--camera", "NAME|INDEX|auto",
                "Camera of the scene, or auto to frame all of it. Default: the first", camera,
                any_text());
    options.add("--view", "SIDE|AZIMUTH,ELEVATION",
                "Frame the whole scene from the front (+z), right (+x), back, left, top, bottom or "
                "three-quarter, or by angles [degrees]: azimuth from the front to the right, "
                "elevation upwards",
                view.direction, view_direction());
    options.add("--margin", "M%",
                "Frame the whole scene with this margin on each side, relative to width and "
                "height. Default: 10%",
                view.margin, margin());
    options.add_flag("--ortho", "Frame the whole scene with an orthographic camera",
                     view.projection, on_or_off(Projection::orthographic, Projection::perspective));
    options.add("--from", "X,Y,Z", "Position of the camera [m]", view.from, point());
    options.add("--look-at", "X,Y,Z", "Point that the camera looks at [m]", view.look_at, point());
    options.add("--fov", "DEG", "Vertical field of view [degrees]", view.vertical_fov,
                field_of_view());
    options.add("--focal-length", "MM",
                "Field of view by focal length, for a sensor 24 mm high [mm]", view.vertical_fov,
                focal_length());
}

std::vector<Conflict> view_conflicts()
{
    std::vector<Conflict> conflicts{{"--lens-radius", "--f-stop"},
                                    {"--focal-length", "--fov"},
                                    {"--ortho", "--fov"},
                                    {"--ortho", "--focal-length"}};
    for (const std::string_view framing : {"--view", "--margin", "--ortho"}) {
        for (const std::string_view other : {"--from", "--look-at", "--cameras", "--camera"}) {
            conflicts.push_back({framing, other});
        }
    }
    return conflicts;
}

void check_camera_options(const OptionList& options, const std::optional<std::string>& camera)
{
    for (const Conflict& conflict : view_conflicts()) {
        if (conflict.other != "--camera") {
            check(std::span(&conflict, 1), options);
        } else if (options.given(conflict.option) && camera && *camera != "auto") {
            throw OptionError(
                fmt::format("{} frames the whole scene and cannot be combined with --camera \"{}\"",
                            conflict.option, *camera));
        }
    }
}

namespace {

bool is_finite(double value)
{
    return std::isfinite(static_cast<float>(value));
}

/// Returns the depth [m] of the surface in the middle of `camera`'s view, if any.
std::optional<float> depth_in_the_middle(const Scene& scene, CameraDesc camera, const Size& size)
{
    constexpr float narrow = 1e-4f;  // [rad]; a film of one pixel is then the middle of the view
    camera.lens_radius = 0.0f;
    RenderOptions options;
    options.integrator = IntegratorKind::pt;
    if (camera.shift == Vec2(0.0f)) {
        camera.vertical_fov = narrow;
        options.film.width = 1;
        options.film.height = 1;
    } else {
        options.film.width = size.width;
        options.film.height = size.height;
        const int x = size.width / 2;
        const int y = size.height / 2;
        options.film.crop = PixelRect{.x0 = x, .y0 = y, .x1 = x + 1, .y1 = y + 1};
    }
    options.film.aovs = AovSet{Aov::depth};
    options.sampling.samples = {0, 1};
    options.transport.max_depth = 1;
    options.system.threads = 1;
    const RenderResult seen = render(scene, camera, options);
    const float depth = seen.aovs.develop(seen.film).at(0).values.at(0);
    return depth > 0.0f && std::isfinite(depth) ? std::optional(depth) : std::nullopt;
}

/// Returns the lens radius [m].
float compute_radius(const LensChoice& lens, const CameraDesc& camera)
{
    if (lens.radius) {
        return static_cast<float>(*lens.radius);
    }
    if (!lens.f_stop) {
        return camera.lens_radius;
    }
    const double radius =
        compute_lens_radius(*lens.f_stop, static_cast<double>(camera.vertical_fov));
    if (!is_finite(radius)) {
        reject("--f-stop", fmt::format("{}", *lens.f_stop), "a greater number for this view");
    }
    return static_cast<float>(radius);
}

}  // namespace

void add_lens_options(OptionList& options, LensChoice& lens)
{
    constexpr double most = std::numeric_limits<float>::max();
    options.add("--lens-radius", "M", "Lens radius [m] for depth of field; 0 is a pinhole",
                lens.radius, number(0.0, most, "metres, 0 or more"));
    options.add("--f-stop", "N",
                "Lens radius by f-number N: f / (2 N), with the focal length f = 12 mm / tan(fov / "
                "2) of a sensor 24 mm high",
                lens.f_stop, positive_number("a number above 0"));
    options.add("--focus-distance", "M",
                "Focus distance [m]. Default: that of the file's lens, else the depth at the image "
                "centre",
                lens.focus_distance, positive_number("metres, above 0"));
}

CameraDesc with_lens(const LensChoice& lens, CameraDesc camera, const Scene& scene,
                     const Size& size)
{
    if (!lens.radius && !lens.f_stop && !lens.focus_distance) {
        return camera;
    }
    if (camera.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} is orthographic: --lens-radius, --f-stop and "
                                "--focus-distance need a perspective camera",
                                camera.name));
    }
    const bool had_lens = camera.lens_radius > 0.0f;
    camera.lens_radius = compute_radius(lens, camera);
    if (lens.focus_distance) {
        if (!lens.radius && camera.lens_radius == 0.0f) {
            throw OptionError(
                "--focus-distance needs --lens-radius or --f-stop: the camera has no lens");
        }
        camera.focus_distance = static_cast<float>(*lens.focus_distance);
    } else if (!had_lens && camera.lens_radius > 0.0f) {
        const std::optional<float> depth = depth_in_the_middle(scene, camera, size);
        if (!depth) {
            throw Error(ErrorCode::usage,
                        "no surface is at the image centre to focus on; give --focus-distance");
        }
        camera.focus_distance = *depth;
    }
    return camera;
}

Vec3 orbit_center(const CameraDesc& camera, const std::optional<Vec3>& look_at, Vec3 middle)
{
    if (look_at) {
        return *look_at;
    }
    const Vec3 eye(camera.world_from_camera[3]);
    const Vec3 forward = -glm::normalize(Vec3(camera.world_from_camera[2]));
    const float distance = glm::dot(middle - eye, forward);
    if (!(distance > 0.0f)) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} looks away from the centre of the scene: --orbit needs "
                                "--look-at, the point to orbit",
                                camera.name));
    }
    return eye + distance * forward;
}

namespace {

std::optional<io::Shutter> parse_shutter(std::string_view text)
{
    const std::size_t comma = text.find(',');
    const bool pair = comma != std::string_view::npos;
    const std::optional<double> open = pair ? parse_double(text.substr(0, comma)) : 0.0;
    const std::optional<double> close = parse_double(pair ? text.substr(comma + 1) : text);
    if (!open || !close || *close < *open) {
        return std::nullopt;
    }
    return io::Shutter{*open, *close};
}

}  // namespace

void add_scene_options(OptionList& options, io::GltfOptions& scene,
                       std::optional<std::uint64_t>& max_memory)
{
    options.add("--scene", "NAME|INDEX", "Scene of the file. Default: the file's default scene",
                scene.scene, any_text());
    options.add("--variant", "NAME|INDEX", "Material variant. Default: the materials of the meshes",
                scene.variant, any_text());
    options.add("--frame-time", "SECONDS",
                "Animation time to render [s]. Without this and --animation nothing is animated",
                scene.time, finite_number("a finite number of seconds"));
    options.add("--animation", "NAME|INDEX|all",
                "Animation for --frame-time, or all. Default: the first", scene.animation,
                any_text());
    options.add(
        "--shutter", "SECONDS|OPEN,CLOSE",
        "Motion blur: seconds that the shutter is open after --frame-time, or OPEN,CLOSE "
        "relative to it",
        scene.shutter,
        parsed_by(parse_shutter, "seconds from 0, or OPEN,CLOSE with OPEN not after CLOSE"));
    Option& library =
        options.add("--ktx-library", "FILE|DIR",
                    "libktx 4 for KTX2 textures (KHR_texture_basisu): the library or its folder. "
                    "Default: the system's libktx.so.4",
                    scene.ktx_library, some_text("a file or a folder"));
    library.uses.stated_in = StatedIn::programs;  // it is code
    options
        .add_repeated(
            "--allow-folder", "DIR",
            "Folder outside of the scene's own that may have files of the scene, also behind "
            "symbolic links. Repeatable",
            scene.allowed_folders, file_path())
        .uses.stated_in = StatedIn::programs;  // it decides what the scene reads
    options.add_flag("--ignore-required",
                     "Render files that require unsupported extensions, or libktx where it is "
                     "missing, without these features",
                     scene.ignore_required);
    options.add_flag("--strict",
                     "Refuse files whose picture would lack something (missing textures, "
                     "extensions that are not supported, ...) or needs drafts of extensions, with "
                     "exit code 5, where a warning or a note is usual",
                     scene.strict);
    options.add("--max-memory", "SIZE",
                "Refuse scenes that need more memory than this, like 500M or 2G; a render includes "
                "its film and layers. Default: half of the machine's memory. Maximum: free memory, "
                "within the limits of the container and of ulimit -v",
                max_memory, memory_size());
}

void add_environment_options(OptionList& options, EnvironmentChange& change)
{
    options.add("--env-rotation", "DEG",
                "Rotate the environment about the vertical axis, counter-clockwise seen from "
                "above: 90 moves -z to -x [degrees]",
                change.rotation, number(-360.0, 360.0, "degrees from -360 to 360"));
    options.add("--env-intensity", "X", "Multiply the radiance of the environment by this",
                change.intensity, number(0.0, 1e6, "a factor from 0 to 1000000"));
}

void add_fog_options(OptionList& options, MediumDesc& fog)
{
    options.add("--fog", "X|R,G,B",
                "Fill the scene, except inside its bodies, with a homogeneous participating medium "
                "of this extinction, 1 / mean free path [1/m]",
                fog.extinction, extinction());
    options.add("--fog-albedo", "X|R,G,B",
                "Single-scattering albedo of the fog, from 0 to 1. Default: 1", fog.albedo,
                albedo());
    options.add("--fog-anisotropy", "G",
                "Anisotropy of the fog's phase function, between -1 and 1: > 0 scatters forward, "
                "like mist. Default: 0, isotropic",
                fog.anisotropy, anisotropy());
}

void add_volume_options(OptionList& options, VolumeChoice& volume)
{
    options
        .add("--volume", "FILE.vdb",
             "Add smoke or a cloud from an OpenVDB file, whose transform is in metres", volume.file,
             ValueType<std::string>{.parse =
                                        [](const std::string& text) {
                                            return text.empty() || text == "-"
                                                       ? std::nullopt
                                                       : std::optional(text);
                                        },
                                    .expected = "a file",
                                    .info = {.is_path = true}})
        .uses.plan_render = false;  // plans store files separately
    options.add("--volume-grid", "NAME",
                "Density grid of the volume. Default: density, or the only float grid",
                volume.options.grid, some_text("the name of a grid"));
    options.add("--volume-extinction", "X|R,G,B",
                "Extinction of the volume where its density is 1 [1/m]. Default: 1",
                volume.options.extinction, extinction());
    options.add("--volume-albedo", "X|R,G,B",
                "Single-scattering albedo of the volume, from 0 to 1. Default: 1",
                volume.options.albedo, albedo());
    options.add("--volume-anisotropy", "G",
                "Anisotropy of the volume's phase function, between -1 and 1: > 0 scatters "
                "forward, like clouds. Default: 0, isotropic",
                volume.options.anisotropy, anisotropy());
    const Choices<io::UpAxis> axes{{{"y", io::UpAxis::y}, {"z", io::UpAxis::z}}};
    add_choice(options, "--volume-up", "Up axis of the file: y (default) or z, as in Blender",
               volume.options.up, axes);
}

void check_medium_options(const OptionList& options)
{
    static constexpr std::array needs{
        Need{"--fog-albedo", "--fog"},       Need{"--fog-anisotropy", "--fog"},
        Need{"--volume-grid", "--volume"},   Need{"--volume-extinction", "--volume"},
        Need{"--volume-albedo", "--volume"}, Need{"--volume-anisotropy", "--volume"},
        Need{"--volume-up", "--volume"},
    };
    check(needs, options);
}

}  // namespace bdpt::job
