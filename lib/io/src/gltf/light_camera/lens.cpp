#include "gltf/light_camera/light_camera.h"

#include <bdpt/thin_lens.h>

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace bdpt::io {
namespace {

/// Reads a number above 0 from the extras of a camera.
std::optional<double> read_positive(const tinygltf::Camera& camera, const char* name,
                                    const std::string& place, LoadContext& context)
{
    if (!camera.extras.IsObject() || !camera.extras.Has(name)) {
        return std::nullopt;
    }
    const tinygltf::Value& value = camera.extras.Get(name);
    if (!value.IsNumber()) {
        context.warn("a value of a lens that is not a number is ignored",
                     fmt::format("{}/extras/{}", place, name));
        return std::nullopt;
    }
    const double number = value.GetNumberAsDouble();
    if (!is_length(number)) {
        context.warn("a value of a lens that is not finite and above 0 is ignored",
                     fmt::format("{}/extras/{}: {}", place, name, number));
        return std::nullopt;
    }
    return number;
}

}  // namespace

bool is_length(double value)
{
    return value >= static_cast<double>(std::numeric_limits<float>::min()) &&
           value <= static_cast<double>(std::numeric_limits<float>::max());
}

Lens read_lens(const tinygltf::Camera& camera, const CameraDesc& desc, const std::string& place,
               LoadContext& context)
{
    const auto read = [&](const char* name) { return read_positive(camera, name, place, context); };
    const std::optional<double> radius = read("lensRadius");
    const std::optional<double> f_stop = read("fStop");
    const std::optional<double> focus = read("focusDistance");
    Lens lens;
    if (desc.projection == Projection::orthographic) {
        if (radius || f_stop || focus) {
            context.warn("the lens of an orthographic camera is ignored", place + "/extras");
        }
        return lens;
    }
    if (focus) {
        lens.focus_distance = static_cast<float>(*focus);
    }
    if (radius && f_stop) {
        context.warn("the f-stop of a camera that has a lens radius too is ignored",
                     place + "/extras/fStop");
    }
    if (radius) {
        lens.radius = static_cast<float>(*radius);
        return lens;
    }
    if (f_stop) {
        const double from_stop =
            compute_lens_radius(*f_stop, static_cast<double>(desc.vertical_fov));
        if (is_length(from_stop)) {
            lens.radius = static_cast<float>(from_stop);
        } else {
            context.warn("a value of a lens that is not finite and above 0 is ignored",
                         fmt::format("{}/extras/fStop: {}", place, *f_stop));
        }
    }
    return lens;
}

}  // namespace bdpt::io
