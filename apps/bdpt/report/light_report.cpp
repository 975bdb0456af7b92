#include "report/light_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "report/values.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

/// Short name of a kind: "point" of "point light".
template <typename Light>
constexpr std::string_view short_kind = Light::kind.substr(0, Light::kind.rfind(" light"));

/// Text around the value of a field.
struct Phrase {
    std::string before;
    std::string_view after;
};

Phrase find_phrase(std::string_view field)
{
    if (field == "position") {
        return {" at ", ""};
    }
    if (field == "direction") {
        return {" towards ", ""};
    }
    if (field == "intensity") {
        return {", ", " cd"};
    }
    if (field == "illuminance") {
        return {", ", " lx"};
    }
    return {fmt::format(", {} ", field), ""};
}

std::string radius_text(float metres)
{
    return metres > 0.0f ? fmt::format(", radius {:.4g} m", metres) : "";
}

// A kind without its own text is described by its fields: all numbers and vectors, but no motion.

/// Returns what to add to a field: only positions depend on the origin.
DVec3 shift_of_field(std::string_view field, const DVec3& origin)
{
    return field == "position" ? origin : DVec3(0.0);
}

struct LightText {
    DVec3 origin;

    template <typename Light>
    std::string operator()(const Light& light) const
    {
        std::string text = fmt::format("{} \"{}\"", short_kind<Light>, light.name);
        for_each_field(light, [&text, this]<typename T>(const auto& field, const T& value) {
            if constexpr (std::is_same_v<T, Vec3>) {
                const auto [before, after] = find_phrase(field.name);
                text += fmt::format("{}{}{}", before,
                                    to_text(value, shift_of_field(field.name, origin)), after);
            } else if constexpr (std::is_arithmetic_v<T>) {
                text += field.name == "radius" ? radius_text(value)
                                               : fmt::format(", {} {:.4g}", field.name, value);
            }
        });
        return text;
    }
    std::string operator()(const SpotLightDesc& light) const
    {
        return fmt::format("spot \"{}\" at {}, {} cd, cone {:.3g} to {:.3g} degrees{}", light.name,
                           to_text(light.position, origin), to_text(light.intensity),
                           degrees(light.inner_cone_angle), degrees(light.outer_cone_angle),
                           radius_text(light.radius));
    }
    std::string operator()(const ProfileLightDesc& light) const
    {
        return fmt::format("profile {} \"{}\" at {}, times {}",
                           static_cast<std::size_t>(light.profile), light.name,
                           to_text(light.position, origin), to_text(light.scale));
    }
    std::string operator()(const EnvironmentLightDesc& light) const
    {
        return fmt::format("environment {}x{}", light.radiance.width(), light.radiance.height());
    }
};

struct LightJson {
    DVec3 origin;

    template <typename Light>
    ordered_json operator()(const Light& light) const
    {
        ordered_json result{{"kind", short_kind<Light>}, {"name", light.name}};
        for_each_field(light, [&result, this]<typename T>(const auto& field, const T& value) {
            std::string name(field.name);
            std::replace(name.begin(), name.end(), ' ', '_');
            if constexpr (std::is_same_v<T, Vec3>) {
                result[name] = to_json(value, shift_of_field(field.name, origin));
            } else if constexpr (std::is_arithmetic_v<T>) {
                result[name] = value;
            }
        });
        return result;
    }
    ordered_json operator()(const SpotLightDesc& light) const
    {
        return {{"kind", "spot"},
                {"name", light.name},
                {"position", to_json(light.position, origin)},
                {"direction", to_json(light.direction)},
                {"intensity", to_json(light.intensity)},
                {"inner_cone_degrees", degrees(light.inner_cone_angle)},
                {"outer_cone_degrees", degrees(light.outer_cone_angle)},
                {"radius", light.radius}};
    }
    ordered_json operator()(const ProfileLightDesc& light) const
    {
        return {{"kind", "profile"},
                {"name", light.name},
                {"position", to_json(light.position, origin)},
                {"profile", static_cast<std::size_t>(light.profile)},
                {"scale", to_json(light.scale)}};
    }
    ordered_json operator()(const EnvironmentLightDesc& light) const
    {
        return {{"kind", "environment"},
                {"width", light.radiance.width()},
                {"height", light.radiance.height()}};
    }
};

}  // namespace

LightDesc without_pixels(const LightDesc& light)
{
    if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
        return EnvironmentLightDesc{.radiance = Image{.width = environment->radiance.width(),
                                                      .height = environment->radiance.height(),
                                                      .pixels = {}}};
    }
    return light;
}

std::string light_text(const LightDesc& light, const DVec3& origin)
{
    return std::visit(LightText{origin}, light);
}

ordered_json light_json(const LightDesc& light, const DVec3& origin)
{
    return std::visit(LightJson{origin}, light);
}

}  // namespace bdpt::app
