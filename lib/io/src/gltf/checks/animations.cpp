#include "gltf/checks/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace bdpt::io {

namespace {

JsonPlace require(const JsonPlace& place, std::string_view key)
{
    if (!place.has(key)) {
        place.fail(fmt::format("\"{}\" is missing", key));
    }
    return place.member(key);
}

template <std::size_t n>
bool is_one_of(const Json& value, const std::string_view (&words)[n])
{
    return std::any_of(std::begin(words), std::end(words),
                       [&value](std::string_view word) { return value == word; });
}

/// Returns which meshes have morph targets.
std::vector<bool> find_morphing(const JsonPlace& root)
{
    std::vector<bool> morphing;
    if (!root.has("meshes")) {
        return morphing;
    }
    for (const Json& mesh : root.member("meshes").value()) {
        const Json& primitives = mesh["primitives"];
        morphing.push_back(
            std::any_of(primitives.begin(), primitives.end(), [](const Json& primitive) {
                return primitive.contains("targets") && !primitive["targets"].empty();
            }));
    }
    return morphing;
}

/// Tests whether the node has the animated property.
bool can_move(const Json& node, const Json& path, const std::vector<bool>& morphing)
{
    if (path == "weights") {
        return node.contains("mesh") && morphing[node["mesh"].get<std::size_t>()];
    }
    return !node.contains("matrix");
}

void check_sampler(const JsonPlace& sampler)
{
    if (sampler.has("interpolation")) {
        const JsonPlace place = sampler.member("interpolation");
        if (!is_one_of(place.value(), {"LINEAR", "STEP", "CUBICSPLINE"})) {
            place.fail(brief(place.value()) + " is not an interpolation");
        }
    }
    require(sampler, "input");
    require(sampler, "output");
}

void check_channel(const JsonPlace& root, const std::vector<bool>& morphing,
                   const JsonPlace& animation, const JsonPlace& channel, LoadContext& context)
{
    const JsonPlace target = require(channel, "target");
    const JsonPlace path = require(target, "path");
    if (!is_one_of(path.value(), {"translation", "rotation", "scale", "weights"})) {
        context.warn(WarningKind::loss,
                     "only translation, rotation, scale and weights of nodes are animated",
                     fmt::format("{}: {}", path.pointer(), brief(path.value())));
        return;
    }
    if (!target.has("node")) {
        return;  // The target belongs to some extension [glTF 2.0, sec. 5.6.1].
    }
    const JsonPlace nodes = root.member("nodes");
    const auto node = static_cast<std::size_t>(target.member("node").as_unsigned());
    if (!can_move(nodes.value()[node], path.value(), morphing)) {
        return;
    }
    const JsonPlace samplers = require(animation, "samplers");
    const JsonPlace index = require(channel, "sampler");
    if (index.as_unsigned() >= samplers.size()) {
        index.fail(fmt::format("index {}, but the number of samplers is {}", index.as_unsigned(),
                               samplers.size()));
    }
    check_sampler(samplers.element(static_cast<std::size_t>(index.as_unsigned())));
}

}  // namespace

void check_animations(const JsonPlace& root, std::span<const std::size_t> played,
                      LoadContext& context)
{
    if (played.empty()) {
        return;
    }
    const std::vector<bool> morphing = find_morphing(root);
    const JsonPlace animations = root.member("animations");
    for (const std::size_t index : played) {
        const JsonPlace animation = animations.element(index);
        const JsonPlace channels = require(animation, "channels");
        for (std::size_t i = 0; i < channels.size(); ++i) {
            check_channel(root, morphing, animation, channels.element(i), context);
        }
    }
}

}  // namespace bdpt::io
