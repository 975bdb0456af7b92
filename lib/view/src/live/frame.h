#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/part/sample_rates.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace bdpt::view {

/// A connected page.
using ClientId = std::uint64_t;

/// A picture for the pages, which share it.
struct Frame {
    std::uint32_t slot = 0;        ///< index of the integrator that made it
    std::uint32_t generation = 0;  ///< version of the view, incremented with each change
    /// Width of the whole picture [pixels]; less for coarse pictures.
    std::uint32_t grid_width = 0;
    std::uint32_t grid_height = 0;
    std::uint32_t x = 0;  ///< position of `pixels` in the grid
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 0;
    std::uint32_t channels = 3;          ///< 3: RGB; 5: RGB, covered and background fraction
    std::uint32_t denoised = 0;          ///< 1: denoised for the page
    std::vector<std::uint8_t> pixels{};  ///< halves, little-endian
    /// Last request of each page that the picture reflects.
    std::map<ClientId, std::uint32_t> sequences{};
};

/// Bytes before the pixels.
inline constexpr std::size_t frame_header_bytes = 52;
using FrameHeader = std::array<std::uint8_t, frame_header_bytes>;

/// Returns the header before the pixels for `client`: 13 numbers of 32 bits, little-endian.
[[nodiscard]] FrameHeader frame_header(const Frame& frame, ClientId client);

/// Coverage of a background by the pixels of an image; empty if there is none.
struct Cover {
    std::span<const float> alpha{};
    std::span<const float> shadow{};  ///< part of alpha that is a black shadow; may be empty
};

/// Converts pixels to halves [IEEE 754 binary16]: RGB, and with `cover` the fractions of the pixel
/// that have this light and that show the background. Negative and non-finite values become 0,
/// greater values than the largest half become that.
[[nodiscard]] std::vector<std::uint8_t> half_pixels(const Image& image, const Cover& cover = {});

// Scalars as images: red is the position on a false-colour scale, in [0, 1].

/// A labelled position on a scale.
struct Tick {
    double place = 0.0;  ///< in [0, 1]
    std::string text;
};

/// Legend of false colours.
struct Scale {
    std::string label;
    std::vector<Tick> ticks;
};

/// Returns the noise by blocks of 8 x 8 pixels: the standard error of a pixel (root mean square)
/// relative to the block's mean, which counts as at least 1 % of the image's mean. Black before
/// there are two samples.
[[nodiscard]] Image noise_image(const Film& film);
[[nodiscard]] Scale noise_scale();

/// Returns the number of samples per round of pixels in the film's region.
[[nodiscard]] Image rates_image(const SampleRates& rates, const PixelRect& region);
[[nodiscard]] Scale rates_scale();

}  // namespace bdpt::view
