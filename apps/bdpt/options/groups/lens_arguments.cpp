#include "options/groups/lens_arguments.h"

#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/thin_lens.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "options/arguments.h"

namespace bdpt::app {
namespace {

bool is_finite(double value)
{
    return std::isfinite(static_cast<float>(value));
}

void check_positive(const char* option, const std::optional<double>& value, const char* expected)
{
    if (value && !(static_cast<float>(*value) > 0.0f && is_finite(*value))) {
        reject(option, fmt::format("{}", *value), expected);
    }
}

/// Depth [m] of what `camera` sees in the middle of its view, if there is anything.
std::optional<float> depth_in_the_middle(const Scene& scene, CameraDesc camera)
{
    constexpr float narrow = 1e-4f;  // [rad]: a film of one pixel is the middle of the view
    camera.lens_radius = 0.0f;
    camera.vertical_fov = narrow;
    RenderOptions options;
    options.integrator = IntegratorKind::pt;
    options.film.width = 1;
    options.film.height = 1;
    options.film.aovs = AovSet{Aov::depth};
    options.sampling.samples = {0, 1};
    options.transport.max_depth = 1;
    options.system.threads = 1;
    const RenderResult seen = render(scene, camera, options);
    const float depth = seen.aovs.develop(seen.film).at(0).values.at(0);
    return depth > 0.0f && std::isfinite(depth) ? std::optional(depth) : std::nullopt;
}

/// [m]
float radius_of(const LensWords& words, const CameraDesc& camera)
{
    if (words.radius) {
        return static_cast<float>(*words.radius);
    }
    if (!words.f_stop) {
        return camera.lens_radius;
    }
    const double radius = lens_radius_of(*words.f_stop, static_cast<double>(camera.vertical_fov));
    if (!is_finite(radius)) {
        reject("--f-stop", fmt::format("{}", *words.f_stop), "a greater number for this view");
    }
    return static_cast<float>(radius);
}

}  // namespace

void add_lens_options(CLI::App& command, LensWords& words)
{
    const auto group = "What to render";
    CLI::Option* radius = command
                              .add_option("--lens-radius", words.radius,
                                          "Lens radius [m] for depth of field; 0 is a pinhole")
                              ->type_name("M")
                              ->group(group);
    command
        .add_option("--f-stop", words.f_stop,
                    "Lens radius by f-number N: f / (2 N), with the focal length f = 12 mm / "
                    "tan(fov / 2) of a sensor 24 mm high")
        ->excludes(radius)
        ->type_name("N")
        ->group(group);
    command
        .add_option("--focus-distance", words.focus_distance,
                    "Focus distance [m]. Default: that of the file's lens, else the depth at the "
                    "image centre")
        ->type_name("M")
        ->group(group);
}

void check_lens(const LensWords& words)
{
    if (words.radius && !(*words.radius >= 0.0 && is_finite(*words.radius))) {
        reject("--lens-radius", fmt::format("{}", *words.radius), "metres, 0 or more");
    }
    check_positive("--f-stop", words.f_stop, "a number above 0");
    check_positive("--focus-distance", words.focus_distance, "metres, above 0");
}

CameraDesc with_lens(const LensWords& words, CameraDesc camera, const Scene& scene)
{
    if (!words.radius && !words.f_stop && !words.focus_distance) {
        return camera;
    }
    if (camera.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage,
                    fmt::format("camera {} is orthographic and has no lens: --lens-radius, "
                                "--f-stop and --focus-distance need another",
                                camera.name));
    }
    const bool had_lens = camera.lens_radius > 0.0f;
    camera.lens_radius = radius_of(words, camera);
    if (words.focus_distance) {
        if (!words.radius && camera.lens_radius == 0.0f) {
            reject("--focus-distance", fmt::format("{}", *words.focus_distance),
                   "--lens-radius or --f-stop with it, as the camera has no lens");
        }
        camera.focus_distance = static_cast<float>(*words.focus_distance);
    } else if (!had_lens && camera.lens_radius > 0.0f) {
        const std::optional<float> depth = depth_in_the_middle(scene, camera);
        if (!depth) {
            throw Error(ErrorCode::usage,
                        "nothing is in the middle of the view to focus on; give --focus-distance");
        }
        camera.focus_distance = *depth;
    }
    return camera;
}

}  // namespace bdpt::app
