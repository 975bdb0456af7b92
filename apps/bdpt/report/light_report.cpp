#include "report/light_report.h"

#include <fmt/core.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <variant>

#include "report/values.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

struct LightText {
    static std::string radius(float metres)
    {
        return metres > 0.0f ? fmt::format(", radius {:.4g} m", metres) : "";
    }
    std::string operator()(const PointLightDesc& light) const
    {
        return fmt::format("point \"{}\" at {}, {} cd{}", light.name, to_text(light.position),
                           to_text(light.intensity), radius(light.radius));
    }
    std::string operator()(const SpotLightDesc& light) const
    {
        return fmt::format("spot \"{}\" at {}, {} cd, cone {:.3g} to {:.3g} degrees{}", light.name,
                           to_text(light.position), to_text(light.intensity),
                           degrees(light.inner_cone_angle), degrees(light.outer_cone_angle),
                           radius(light.radius));
    }
    std::string operator()(const DirectionalLightDesc& light) const
    {
        return fmt::format("directional \"{}\" towards {}, {} lx", light.name,
                           to_text(light.direction), to_text(light.illuminance));
    }
    std::string operator()(const ProfileLightDesc& light) const
    {
        return fmt::format("profile {} \"{}\" at {}, times {}",
                           static_cast<std::size_t>(light.profile), light.name,
                           to_text(light.position), to_text(light.scale));
    }
    std::string operator()(const EnvironmentLightDesc& light) const
    {
        return fmt::format("environment {}x{}", light.radiance.width, light.radiance.height);
    }
};

struct LightJson {
    ordered_json operator()(const PointLightDesc& light) const
    {
        return {{"kind", "point"},
                {"name", light.name},
                {"position", to_json(light.position)},
                {"intensity", to_json(light.intensity)},
                {"radius", light.radius}};
    }
    ordered_json operator()(const SpotLightDesc& light) const
    {
        return {{"kind", "spot"},
                {"name", light.name},
                {"position", to_json(light.position)},
                {"direction", to_json(light.direction)},
                {"intensity", to_json(light.intensity)},
                {"inner_cone_degrees", degrees(light.inner_cone_angle)},
                {"outer_cone_degrees", degrees(light.outer_cone_angle)},
                {"radius", light.radius}};
    }
    ordered_json operator()(const DirectionalLightDesc& light) const
    {
        return {{"kind", "directional"},
                {"name", light.name},
                {"direction", to_json(light.direction)},
                {"illuminance", to_json(light.illuminance)}};
    }
    ordered_json operator()(const ProfileLightDesc& light) const
    {
        return {{"kind", "profile"},
                {"name", light.name},
                {"position", to_json(light.position)},
                {"profile", static_cast<std::size_t>(light.profile)},
                {"scale", to_json(light.scale)}};
    }
    ordered_json operator()(const EnvironmentLightDesc& light) const
    {
        return {{"kind", "environment"},
                {"width", light.radiance.width},
                {"height", light.radiance.height}};
    }
};

}  // namespace

LightDesc without_pixels(const LightDesc& light)
{
    if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
        EnvironmentLightDesc result;
        result.radiance.width = environment->radiance.width;
        result.radiance.height = environment->radiance.height;
        return result;
    }
    return light;
}

std::string light_text(const LightDesc& light)
{
    return std::visit(LightText{}, light);
}

ordered_json light_json(const LightDesc& light)
{
    return std::visit(LightJson{}, light);
}

}  // namespace bdpt::app
