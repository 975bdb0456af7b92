#include "gltf/animation/animation.h"

#include "gltf/document/document.h"

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

/// Target property of an animation channel.
struct Path {
    std::string_view name;
    std::vector<double> tinygltf::Node::*member;
    int type;  // tinygltf type of the values
    std::size_t width;
    Quantity quantity;
};

constexpr Path paths[] = {
    {"translation", &tinygltf::Node::translation, TINYGLTF_TYPE_VEC3, 3, Quantity::numbers},
    {"rotation", &tinygltf::Node::rotation, TINYGLTF_TYPE_VEC4, 4, Quantity::rotation},
    {"scale", &tinygltf::Node::scale, TINYGLTF_TYPE_VEC3, 3, Quantity::numbers},
    {"weights", &tinygltf::Node::weights, TINYGLTF_TYPE_SCALAR, 0, Quantity::numbers},
};

[[noreturn]] void fail(const std::string& place, const std::string& what)
{
    throw Error(ErrorCode::invalid_input, place + ": " + what);
}

Interpolation parse_interpolation(const tinygltf::AnimationSampler& sampler)
{
    if (sampler.interpolation == "STEP") {
        return Interpolation::step;
    }
    return sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubic_spline
                                                  : Interpolation::linear;
}

/// Returns the number of morph targets of the node's mesh: the maximum over its primitives.
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

std::vector<float> read_column(const tinygltf::Model& model, const std::string& place, int accessor,
                               int type, Integers integers, LoadContext& context)
{
    const auto& described = model.accessors[static_cast<std::size_t>(accessor)];
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(described.type));
    context.budget.spend(place, described.count,
                         static_cast<std::uint64_t>(components) * sizeof(float));
    std::vector<float> values = read_numbers(model, accessor, type, integers);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            fail(place, fmt::format("accessor {}: number {} is {}", accessor, i, values[i]));
        }
    }
    return values;
}

/// Reads the key frames of a sampler; `place` is the sampler's.
KeyFrames read_key_frames(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                          const std::string& place, const Path& path, std::size_t width,
                          LoadContext& context)
{
    KeyFrames frames;
    frames.interpolation = parse_interpolation(sampler);
    frames.width = width;
    const std::string input = place + "/input";
    frames.times = read_column(model, input, sampler.input, TINYGLTF_TYPE_SCALAR,
                               Integers::as_declared, context);
    const auto stop = std::adjacent_find(frames.times.begin(), frames.times.end(),
                                         [](float a, float b) { return !(a < b); });
    if (stop != frames.times.end()) {
        fail(input, fmt::format("key frame {} is at {} s, but must be after {} s",
                                stop - frames.times.begin() + 1, *(stop + 1), *stop));
    }
    const std::string output = place + "/output";
    // Integers are fractions, whether marked as normalized or not [glTF 2.0, sec. 3.11].
    frames.values =
        read_column(model, output, sampler.output, path.type, Integers::normalized, context);
    const std::size_t rows = frames.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const std::size_t needed = frames.times.size() * rows * width;
    if (frames.values.size() < needed) {
        fail(output, fmt::format("{} numbers, but {} key frames need {}", frames.values.size(),
                                 frames.times.size(), needed));
    }
    return frames;
}

/// Reads a channel of the animation at `place`; returns none if it has no target.
std::optional<AnimatedProperty> read_channel(const tinygltf::Model& model,
                                             const tinygltf::Animation& animation,
                                             std::size_t index, const std::string& place,
                                             LoadContext& context)
{
    const tinygltf::AnimationChannel& channel = animation.channels[index];
    const auto* path = std::find_if(std::begin(paths), std::end(paths), [&](const Path& known) {
        return channel.target_path == known.name;
    });
    if (path == std::end(paths) || channel.target_node < 0) {
        return std::nullopt;  // check_animations has warned of it if necessary.
    }
    const std::string target = fmt::format("{}/channels/{}/target", place, index);
    const auto number = static_cast<std::size_t>(channel.target_node);
    const tinygltf::Node& node = model.nodes[number];
    const bool weights = path->name == "weights";
    if (weights && node.mesh >= 0) {
        // Each channel visits all primitives.
        const auto& mesh = model.meshes[static_cast<std::size_t>(node.mesh)];
        context.budget.spend(target, mesh.primitives.size(), sizeof(double));
    }
    const std::size_t width = weights ? count_targets(model, node) : path->width;
    if (weights && width == 0) {
        context.warn("weights of a node without morph targets are not animated", target);
        return std::nullopt;
    }
    if (!weights && !node.matrix.empty()) {
        context.warn("a node that has a matrix is not animated", target);
        return std::nullopt;
    }
    const auto sampler = static_cast<std::size_t>(channel.sampler);
    return AnimatedProperty{
        number, path->member, path->quantity,
        read_key_frames(model, animation.samplers.at(sampler),
                        fmt::format("{}/samplers/{}", place, sampler), *path, width, context)};
}

void check_shutter(const Shutter& shutter)
{
    if (!std::isfinite(shutter.open) || !std::isfinite(shutter.close) ||
        shutter.close < shutter.open) {
        throw Error(ErrorCode::usage, fmt::format("invalid shutter: opens at {} s, closes at {} s",
                                                  shutter.open, shutter.close));
    }
}

}  // namespace

std::vector<std::size_t> select_animations(const std::vector<std::string>& names,
                                           const GltfOptions& options, LoadContext& context)
{
    if (options.time && !std::isfinite(*options.time)) {
        throw Error(ErrorCode::usage, fmt::format("invalid animation time: {}", *options.time));
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
        context.warn("several animations and none is chosen: the first one is used",
                     fmt::format("/animations: {}", names.size()));
    }
    return {0};
}

std::vector<AnimatedProperty> read_animation(const tinygltf::Model& model, std::size_t index,
                                             LoadContext& context)
{
    const tinygltf::Animation& animation = model.animations[index];
    const std::string place = fmt::format("/animations/{}", index);
    std::vector<AnimatedProperty> properties;
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
        if (auto property = read_channel(model, animation, i, place, context)) {
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
