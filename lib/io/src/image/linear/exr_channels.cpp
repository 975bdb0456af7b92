#include "image/linear/exr_channels.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <vector>

namespace bdpt::io {

namespace {

bool has(const Imf::ChannelList& channels, const std::string& name)
{
    return channels.findChannel(name.c_str()) != nullptr;
}

/// Returns the part of a channel's name before the last dot, with the dot; empty without a dot.
std::string find_prefix(const std::string& channel)
{
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot + 1);
}

std::optional<ColorChannels> find_triple(const Imf::ChannelList& channels,
                                         const std::string& prefix, std::string_view letters)
{
    ColorChannels result{.prefix = prefix, .names = {}};
    for (std::size_t c = 0; c < letters.size(); ++c) {
        result.names[c] = prefix + letters[c];
        if (!has(channels, result.names[c])) {
            return std::nullopt;
        }
    }
    return result;
}

/// Returns all layers, for the message that a layer does not exist.
std::string all_layers(const Imf::ChannelList& channels)
{
    std::set<std::string> names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string prefix = find_prefix(channel.name());
        names.insert(prefix.empty() ? channel.name() : prefix.substr(0, prefix.size() - 1));
    }
    return fmt::format("\"{}\"", fmt::join(names, "\", \""));
}

}  // namespace

std::optional<ColorChannels> find_colors(const Imf::ChannelList& channels)
{
    // Every channel's prefix is a candidate; the empty one, if any, comes first.
    std::vector<std::string> prefixes{""};
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string prefix = find_prefix(channel.name());
        if (!prefix.empty()) {
            prefixes.push_back(prefix);
        }
    }
    for (const std::string& prefix : prefixes) {
        if (const auto colors = find_triple(channels, prefix, "RGB")) {
            return colors;
        }
    }
    for (const std::string& prefix : prefixes) {
        if (has(channels, prefix + "Y")) {
            const bool chroma = has(channels, prefix + "RY") && has(channels, prefix + "BY");
            return ColorChannels{.prefix = prefix, .names = {prefix + "Y"}, .chroma = chroma};
        }
    }
    return std::nullopt;
}

ColorChannels find_layer(const Imf::ChannelList& channels, const std::string& name)
{
    const std::string prefix = name + ".";
    for (const std::string_view letters : {"RGB", "XYZ"}) {
        if (const auto colors = find_triple(channels, prefix, letters)) {
            return *colors;
        }
    }
    if (has(channels, name)) {
        return ColorChannels{.prefix = "", .names = {name}};
    }
    std::vector<std::string> own;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (find_prefix(channel.name()) == prefix) {
            own.emplace_back(channel.name());
        }
    }
    if (own.empty()) {
        throw Error(ErrorCode::not_found,
                    fmt::format("no layer \"{}\"; the file has {}", name, all_layers(channels)));
    }
    if (own.size() > 1) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("layer \"{}\" has the channels {}: neither R, G, B nor X, Y, Z "
                                "nor a single one",
                                name, fmt::join(own, ", ")));
    }
    return ColorChannels{.prefix = prefix, .names = {own.front()}};
}

}  // namespace bdpt::io
