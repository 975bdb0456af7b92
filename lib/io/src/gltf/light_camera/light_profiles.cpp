#include "gltf/light_camera/light_camera.h"

#include "gltf/animation/node_transforms.h"
#include "ies/ies.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace bdpt::io {

namespace {

/// Clamps a value to [0, most], with a warning.
double in_range(double value, double most, const std::string& place, LoadContext& context)
{
    if (!(value >= 0.0 && value <= most)) {
        context.warn("an out-of-range colour or multiplier of a light profile is clamped",
                     fmt::format("{}: {}", place, value));
    }
    return std::clamp(value, 0.0, most);
}

Rgb read_scale(const tinygltf::Value& light, const std::string& place, LoadContext& context)
{
    constexpr double most = std::numeric_limits<float>::max();
    const double multiplier =
        light.Has("multiplier") ? light.Get("multiplier").GetNumberAsDouble() : 1.0;
    Rgb scale(static_cast<float>(in_range(multiplier, most, place + "/multiplier", context)));
    if (light.Has("color")) {
        const auto& channels = light.Get("color").Get<tinygltf::Value::Array>();
        for (int c = 0; c < 3; ++c) {
            const double channel = channels[static_cast<std::size_t>(c)].GetNumberAsDouble();
            scale[c] *= static_cast<float>(
                in_range(channel, 1.0, fmt::format("{}/color/{}", place, c), context));
        }
    }
    return scale;
}

}  // namespace

const LightProfiles::Known& LightProfiles::get(std::size_t index)
{
    const auto found = known_.find(index);
    if (found != known_.end()) {
        return found->second;
    }
    const std::string place = fmt::format("/extensions/EXT_lights_ies/lights/{}", index);
    const tinygltf::Value& source = find_light(model_, "EXT_lights_ies", index);
    const std::string uri = source.Has("uri") ? source.Get("uri").Get<std::string>() : "";
    const int view = source.Has("bufferView") ? source.Get("bufferView").GetNumberAsInt() : -1;
    try {
        const Bytes bytes = read_source(
            model_, uri, view, std::min(context_.limits.file_bytes, max_ies_bytes), context_);
        IesProfile read =
            make_profile(read_ies(bytes, place, context_.warnings), place, context_.warnings);
        // An intensity is stored several times: in the scene, for look-up and for sampling.
        constexpr std::uint64_t bytes_each = 32;
        context_.budget.spend("what it holds", read.profile.intensities.size(), bytes_each);
        const Known known{static_cast<ProfileId>(profiles_.size()), read.node_from_profile};
        profiles_.push_back(std::move(read.profile));
        return known_.emplace(index, known).first->second;
    } catch (const Error& error) {
        throw Error(error.code(), place + ": " + error.what());
    }
}

std::optional<LightDesc> LightProfiles::read(std::size_t node, const glm::dmat4& world_from_node)
{
    const tinygltf::Node& holder = model_.nodes[node];
    const auto extension = holder.extensions.find("EXT_lights_ies");
    if (extension == holder.extensions.end()) {
        return std::nullopt;
    }
    const tinygltf::Value& light = extension->second;
    const Known& known = get(static_cast<std::size_t>(light.Get("light").GetNumberAsInt()));
    ProfileLightDesc desc;
    desc.name = holder.name;
    desc.position = Vec3(world_from_node[3]);
    desc.world_from_light = compute_axes(world_from_node) * known.node_from_profile;
    desc.scale =
        read_scale(light, fmt::format("/nodes/{}/extensions/EXT_lights_ies", node), context_);
    desc.profile = known.id;
    return desc;
}

}  // namespace bdpt::io
