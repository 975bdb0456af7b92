#pragma once

#include <bdpt/image.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
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
    std::vector<std::uint8_t> pixels{};               ///< halves, RGB, little-endian
    std::map<ClientId, std::uint32_t> sequences{};  ///< the last request of each page that it shows
};

/// Bytes before the pixels.
inline constexpr std::size_t frame_header_bytes = 48;
using FrameHeader = std::array<std::uint8_t, frame_header_bytes>;

/// What goes before the pixels to `client`: 12 numbers of 32 bits, little-endian.
[[nodiscard]] FrameHeader frame_header(const Frame& frame, ClientId client);

/// Pixels as halves [IEEE 754 binary16]. What is not finite or negative becomes 0, what is too much
/// the greatest half.
[[nodiscard]] std::vector<std::uint8_t> half_pixels(const Image& image);

}  // namespace bdpt::app
