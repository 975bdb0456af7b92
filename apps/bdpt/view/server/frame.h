#pragma once

#include <bdpt/image.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace bdpt::app {

/// A page that is connected.
using ClientId = std::uint64_t;

/// A picture on its way to the pages, which share it.
struct Frame {
    std::uint32_t slot = 0;        ///< which of two integrators made it
    std::uint32_t generation = 0;  ///< of what is seen: grows with each change
    std::uint32_t grid_width = 0;  ///< of the whole picture [pixels]; coarse ones have fewer
    std::uint32_t grid_height = 0;
    std::uint32_t x = 0;  ///< where `pixels` lie in the grid
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 0;
    std::uint32_t channels = 3;          ///< 3: RGB; 5: and what covers the background
    std::vector<std::uint8_t> pixels{};  ///< halves, little-endian
    std::map<ClientId, std::uint32_t> sequences{};  ///< the last request of each page that it shows
};

/// Bytes before the pixels.
inline constexpr std::size_t frame_header_bytes = 48;
using FrameHeader = std::array<std::uint8_t, frame_header_bytes>;

/// What goes before the pixels to `client`: 12 numbers of 32 bits, little-endian.
[[nodiscard]] FrameHeader frame_header(const Frame& frame, ClientId client);

/// How far the pixels of an image cover a background; empty where there is none.
struct Cover {
    std::span<const float> alpha{};
    std::span<const float> shadow{};  ///< the part of alpha that is a black shadow; may be empty
};

/// Pixels as halves [IEEE 754 binary16]: RGB, and with `cover` the share of the pixel that has this
/// light and the share that shows the background. What is not finite or negative becomes 0, what is
/// too much the greatest half.
[[nodiscard]] std::vector<std::uint8_t> half_pixels(const Image& image, const Cover& cover = {});

}  // namespace bdpt::app
