#include "gltf/light_camera/light_camera.h"

#include "file/read_file.h"
#include "gltf/animation/node_transforms.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace bdpt::io {

namespace {

constexpr double half_pi = 1.5707963267948966;
// A cone needs some width: smaller angles would lose all digits in the cosine.
constexpr double min_cone = 1e-3;

Rgb read_intensity(const tinygltf::Light& light, const std::string& place, LoadContext& context)
{
    constexpr double most = std::numeric_limits<float>::max();
    Rgb intensity(0.0f);
    for (int c = 0; c < 3; ++c) {
        const double factor =
            light.color.size() == 3 ? light.color[static_cast<std::size_t>(c)] : 1.0;
        const double value = factor * light.intensity;
        if (!(value >= 0.0 && value <= most)) {
            context.warn("an out-of-range intensity is clamped",
                         fmt::format("{}: {}", place, value));
        }
        intensity[c] = static_cast<float>(std::clamp(value, 0.0, most));
    }
    return intensity;
}

SpotLightDesc read_spot(const tinygltf::Light& light, const std::string& place,
                        LoadContext& context)
{
    SpotLightDesc spot;
    const double outer = std::clamp(light.spot.outerConeAngle, min_cone, half_pi);
    const double inner = std::clamp(light.spot.innerConeAngle, 0.0, outer);
    if (outer != light.spot.outerConeAngle || inner != light.spot.innerConeAngle) {
        context.warn("out-of-range cone angles of a spot light are clamped",
                     fmt::format("{}/spot: {} and {}", place, light.spot.innerConeAngle,
                                 light.spot.outerConeAngle));
    }
    spot.outer_cone_angle = static_cast<float>(outer);
    // The edge is never quite sharp: equal angles would leave no room for the fall-off.
    constexpr float sharpest = 0.9999f;
    spot.inner_cone_angle = std::min(static_cast<float>(inner), sharpest * spot.outer_cone_angle);
    return spot;
}

/// Reads `extras.radius` in the node's units; 0 if there is none. Extras are free-form, so an
/// invalid value is no error.
float read_radius(const tinygltf::Light& light, const std::string& place,
                  const glm::dmat4& world_from_node, LoadContext& context)
{
    if (!light.extras.IsObject() || !light.extras.Has("radius")) {
        return 0.0f;
    }
    if (light.type == "directional") {
        context.warn("the radius of a directional light is ignored", place + "/extras/radius");
        return 0.0f;
    }
    const tinygltf::Value& value = light.extras.Get("radius");
    if (!value.IsNumber()) {
        context.warn("a radius that is not a number is ignored", place + "/extras/radius");
        return 0.0f;
    }
    const double radius = value.GetNumberAsDouble();
    if (!(radius >= 0.0) || !std::isfinite(radius)) {
        context.warn("a radius that is negative or not finite is ignored",
                     fmt::format("{}/extras/radius: {}", place, radius));
        return 0.0f;
    }
    return static_cast<float>(radius * mean_scale(world_from_node));
}

}  // namespace

std::optional<LightDesc> read_light(const tinygltf::Model& model, std::size_t node,
                                    const glm::dmat4& world_from_node, LoadContext& context)
{
    const tinygltf::Node& holder = model.nodes[node];
    const auto extension = holder.extensions.find("KHR_lights_punctual");
    if (extension == holder.extensions.end()) {
        return std::nullopt;
    }
    const auto index = static_cast<std::size_t>(extension->second.Get("light").GetNumberAsInt());
    const tinygltf::Light& light = model.lights[index];
    const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    const std::string name = light.name.empty() ? holder.name : light.name;
    const Vec3 position(world_from_node[3]);
    const Vec3 direction = transform_direction(world_from_node, {0.0, 0.0, -1.0});
    const Rgb intensity = read_intensity(light, place, context);
    if (light.range > 0.0) {
        context.warn("the range of a light is ignored: light has no cutoff distance",
                     fmt::format("{}/range: {}", place, light.range));
    }
    const float radius = read_radius(light, place, world_from_node, context);
    if (light.type == "point") {
        return PointLightDesc{name, position, intensity, radius};
    }
    if (light.type == "directional") {
        return DirectionalLightDesc{name, direction, intensity};
    }
    if (light.type == "spot") {
        SpotLightDesc spot = read_spot(light, place, context);
        spot.name = name;
        spot.position = position;
        spot.direction = direction;
        spot.intensity = intensity;
        spot.radius = radius;
        return spot;
    }
    throw Error(ErrorCode::unsupported,
                place + "/type: " + quote(light.type) + " is not supported");
}

}  // namespace bdpt::io
