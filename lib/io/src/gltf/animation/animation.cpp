#include "gltf/animation/animation.h"

#include "file/uri.h"
#include "gltf/animation/keyframes.h"
#include "gltf/document/accessor.h"
#include "gltf/document/selection.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace bdpt::io {

namespace {

/// What a channel of an animation moves.
struct Path {
    std::string_view name;
    std::vector<double> tinygltf::Node::*member;
    int type;  // of the values
    std::size_t width;
    Quantity quantity;
};

constexpr Path paths[] = {
    {"translation", &tinygltf::Node::translation, TINYGLTF_TYPE_VEC3, 3, Quantity::numbers},
    {"rotation", &tinygltf::Node::rotation, TINYGLTF_TYPE_VEC4, 4, Quantity::rotation},
    {"scale", &tinygltf::Node::scale, TINYGLTF_TYPE_VEC3, 3, Quantity::numbers},
    {"weights", &tinygltf::Node::weights, TINYGLTF_TYPE_SCALAR, 0, Quantity::numbers},
};

JsonPlace require(const JsonPlace& place, std::string_view key)
{
    if (!place.has(key)) {
        place.fail(fmt::format("\"{}\" is missing", key));
    }
    return place.member(key);
}

Interpolation read_interpolation(const JsonPlace& sampler)
{
    if (!sampler.has("interpolation")) {
        return Interpolation::linear;
    }
    const JsonPlace place = sampler.member("interpolation");
    if (place.value() == "LINEAR") {
        return Interpolation::linear;
    }
    if (place.value() == "STEP") {
        return Interpolation::step;
    }
    if (place.value() == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    place.fail(brief(place.value()) + " is no interpolation");
}

/// Morph targets of the node's mesh: the most that one of its primitives has.
std::size_t count_targets(const tinygltf::Model& model, const tinygltf::Node& node)
{
    std::size_t count = 0;
    if (node.mesh >= 0) {
        for (const auto& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
            count = std::max(count, primitive.targets.size());
        }
    }
    return count;
}

std::vector<float> read_column(const tinygltf::Model& model, const JsonPlace& place, int type,
                               Integers integers, LoadContext& context)
{
    const auto accessor = static_cast<int>(place.as_unsigned());
    const auto& described = model.accessors[static_cast<std::size_t>(accessor)];
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(described.type));
    context.budget.spend(place.pointer(), described.count,
                         static_cast<std::uint64_t>(components) * sizeof(float));
    std::vector<float> values = read_numbers(model, accessor, type, integers);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            place.fail(fmt::format("accessor {}: number {} is {}", accessor, i, values[i]));
        }
    }
    return values;
}

KeyFrames read_key_frames(const tinygltf::Model& model, const JsonPlace& sampler, const Path& path,
                          std::size_t width, LoadContext& context)
{
    KeyFrames frames;
    frames.interpolation = read_interpolation(sampler);
    frames.width = width;
    const JsonPlace input = require(sampler, "input");
    frames.times = read_column(model, input, TINYGLTF_TYPE_SCALAR, Integers::as_declared, context);
    const auto stop = std::adjacent_find(frames.times.begin(), frames.times.end(),
                                         [](float a, float b) { return !(a < b); });
    if (stop != frames.times.end()) {
        input.fail(fmt::format("key frame {} is at {} s, but must be after {} s",
                               stop - frames.times.begin() + 1, *(stop + 1), *stop));
    }
    const JsonPlace output = require(sampler, "output");
    // Integers are fractions, whether they say so or not [glTF 2.0, sec. 3.11].
    frames.values = read_column(model, output, path.type, Integers::normalized, context);
    const std::size_t rows = frames.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const std::size_t needed = frames.times.size() * rows * width;
    if (frames.values.size() < needed) {
        output.fail(fmt::format("{} numbers, but {} key frames need {}", frames.values.size(),
                                frames.times.size(), needed));
    }
    return frames;
}

/// None where nothing is to be moved.
std::optional<AnimatedProperty> read_channel(const GltfModel& model, const JsonPlace& animation,
                                             const JsonPlace& channel, LoadContext& context)
{
    const JsonPlace target = require(channel, "target");
    const JsonPlace path_place = require(target, "path");
    const auto* path = std::find_if(std::begin(paths), std::end(paths), [&](const Path& known) {
        return path_place.value() == known.name;
    });
    if (path == std::end(paths)) {
        context.warn("only translation, rotation, scale and weights of nodes are animated",
                     fmt::format("{}: {}", path_place.pointer(), brief(path_place.value())));
        return std::nullopt;
    }
    if (!target.has("node")) {
        return std::nullopt;  // Some extension's business [glTF 2.0, sec. 5.6.1].
    }
    const auto number = static_cast<std::size_t>(target.member("node").as_unsigned());
    const tinygltf::Node& node = model.structs.nodes[number];
    const bool weights = path->name == "weights";
    if (weights && node.mesh >= 0) {
        // Each channel looks at all of them.
        const auto& mesh = model.structs.meshes[static_cast<std::size_t>(node.mesh)];
        context.budget.spend(target.pointer(), mesh.primitives.size(), sizeof(double));
    }
    const std::size_t width = weights ? count_targets(model.structs, node) : path->width;
    if (weights && width == 0) {
        context.warn("weights of a node without morph targets are not animated", target.pointer());
        return std::nullopt;
    }
    if (!weights && !node.matrix.empty()) {
        context.warn("a node that has a matrix is not animated", target.pointer());
        return std::nullopt;
    }
    const JsonPlace samplers = require(animation, "samplers");
    const JsonPlace index = require(channel, "sampler");
    if (index.as_unsigned() >= samplers.size()) {
        index.fail(fmt::format("index {}, but there are {} samplers", index.as_unsigned(),
                               samplers.size()));
    }
    const JsonPlace sampler = samplers.element(static_cast<std::size_t>(index.as_unsigned()));
    return AnimatedProperty{number, path->member, path->quantity,
                            read_key_frames(model.structs, sampler, *path, width, context)};
}

void check_shutter(const Shutter& shutter)
{
    if (!std::isfinite(shutter.open) || !std::isfinite(shutter.close) ||
        shutter.close < shutter.open) {
        throw Error(ErrorCode::usage,
                    fmt::format("no times of a shutter: opens at {} s, closes at {} s",
                                shutter.open, shutter.close));
    }
}

}  // namespace

std::vector<std::size_t> select_animations(const std::vector<std::string>& names,
                                           const GltfOptions& options, LoadContext& context)
{
    if (options.time && !std::isfinite(*options.time)) {
        throw Error(ErrorCode::usage, fmt::format("no time of an animation: {}", *options.time));
    }
    if (options.shutter) {
        check_shutter(*options.shutter);
    }
    if (options.animation == "all" && std::find(names.begin(), names.end(), "all") == names.end()) {
        std::vector<std::size_t> all(names.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
    if (options.animation) {
        return {select("animation", names, *options.animation)};
    }
    if (!options.time && !options.shutter) {
        return {};
    }
    if (names.empty()) {
        context.warn("a time is given, but the file has no animations", "/animations");
        return {};
    }
    if (names.size() > 1) {
        context.warn("several animations and none is chosen: the first one plays",
                     fmt::format("/animations: {}", names.size()));
    }
    return {0};
}

std::vector<AnimatedProperty> read_animation(const GltfModel& model, std::size_t animation,
                                             LoadContext& context)
{
    const JsonPlace root(model.motion);
    const JsonPlace animations = root.member("animations");
    const JsonPlace place = animations.element(animation);
    const JsonPlace channels = require(place, "channels");
    std::vector<AnimatedProperty> properties;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (auto property = read_channel(model, place, channels.element(i), context)) {
            properties.push_back(std::move(*property));
        }
    }
    return properties;
}

void pose(tinygltf::Model& model, std::span<const AnimatedProperty> properties, double time)
{
    for (const AnimatedProperty& property : properties) {
        model.nodes[property.node].*(property.member) =
            value_at(property.frames, property.quantity, time);
    }
}

}  // namespace bdpt::io
