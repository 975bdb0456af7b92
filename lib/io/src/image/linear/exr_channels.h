#pragma once

#include <ImfChannelList.h>

#include <array>
#include <optional>
#include <string>

namespace bdpt::io {

/// Names of the channels of one layer that together are colours.
struct ColorChannels {
    std::string prefix;                ///< prefix of the layer, with a dot, or empty
    std::array<std::string, 3> names;  ///< in full; grey: only the first
    bool chroma = false;               ///< RY and BY in addition to Y

    [[nodiscard]] bool grey() const { return names[1].empty(); }
};

/// Finds channels R, G, B, or else Y with or without RY and BY, of the unnamed layer or else of the
/// first that has them; none if there are no such channels.
[[nodiscard]] std::optional<ColorChannels> find_colors(const Imf::ChannelList& channels);

/// Finds the channels of layer `name`: R, G, B; or X, Y, Z in their place; or the only one, as
/// grey. A channel without a layer is found by its own name. Throws `Error`: not_found if there is
/// no such layer, unsupported if it has other channels.
[[nodiscard]] ColorChannels find_layer(const Imf::ChannelList& channels, const std::string& name);

}  // namespace bdpt::io
