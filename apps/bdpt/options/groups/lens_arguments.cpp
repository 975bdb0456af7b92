#include "options/groups/lens_arguments.h"

#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/thin_lens.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>

#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

bool is_finite(double value)
{
    return std::isfinite(static_cast<float>(value));
}

/// Returns the depth [m] of the surface in the middle of `camera`'s view, if any.
std::optional<float> depth_in_the_middle(const Scene& scene, CameraDesc camera)
{
    constexpr float narrow = 1e-4f;  // [rad]; a film of one pixel is then the middle of the view
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

void check_lens_options(const OptionList& options)
{
    static constexpr std::array conflicts{Conflict{"--lens-radius", "--f-stop"}};
    check(conflicts, options);
}

CameraDesc with_lens(const LensChoice& lens, CameraDesc camera, const Scene& scene)
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
        const std::optional<float> depth = depth_in_the_middle(scene, camera);
        if (!depth) {
            throw Error(ErrorCode::usage,
                        "no surface is at the image centre to focus on; give --focus-distance");
        }
        camera.focus_distance = *depth;
    }
    return camera;
}

}  // namespace bdpt::app
