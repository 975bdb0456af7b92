#include "live/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace bdpt::view {
namespace {

constexpr double min_noise = 1e-3;  // at the left end of the scale
constexpr double decades = 3.0;

double luminance(Rgb color)
{
    return 0.2126 * static_cast<double>(color.r) + 0.7152 * static_cast<double>(color.g) +
           0.0722 * static_cast<double>(color.b);
}

struct Block {
    double sum = 0.0;
    double variance = 0.0;
    int pixels = 0;
};

}  // namespace

Image noise_image(const Film& film)
{
    constexpr int side = 8;  // [pixels]
    const Image mean = film.develop();
    const Image variance = film.variance();
    Image result{.width = mean.width, .height = mean.height, .pixels = {}};
    result.pixels.resize(mean.pixels.size(), Rgb(0.0f));
    if (film.sample_count() < 2) {
        return result;
    }
    double total = 0.0;
    for (const Rgb& pixel : mean.pixels) {
        total += luminance(pixel);
    }
    const double darkest =
        0.01 * total / static_cast<double>(std::max<std::size_t>(mean.pixels.size(), 1));
    for (int top = 0; top < mean.height; top += side) {
        for (int left = 0; left < mean.width; left += side) {
            const int bottom = std::min(top + side, mean.height);
            const int right = std::min(left + side, mean.width);
            Block block;
            for (int y = top; y < bottom; ++y) {
                for (int x = left; x < right; ++x) {
                    block.sum += luminance(mean.at(x, y));
                    block.variance += luminance(variance.at(x, y));
                    ++block.pixels;
                }
            }
            // Root mean square over pixels.
            const double error = std::sqrt(block.variance / block.pixels);
            const double noise = error / std::max(block.sum / block.pixels, darkest);
            const double place = noise > 0.0 ? std::log10(noise / min_noise) / decades : 0.0;
            for (int y = top; y < bottom; ++y) {
                for (int x = left; x < right; ++x) {
                    result
                        .pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(mean.width) +
                                static_cast<std::size_t>(x)] =
                        Rgb(static_cast<float>(std::clamp(place, 0.0, 1.0)), 0.0f, 0.0f);
                }
            }
        }
    }
    return result;
}

Scale noise_scale()
{
    return {
        .label = "noise of a pixel, by blocks of 8 x 8",
        .ticks = {{0.0, "0.1 %"}, {1.0 / decades, "1 %"}, {2.0 / decades, "10 %"}, {1.0, "100 %"}}};
}

Image rates_image(const SampleRates& rates, const PixelRect& region)
{
    constexpr auto span = static_cast<float>(SampleRates::max_exponent - SampleRates::min_exponent);
    Image result{.width = region.width(), .height = region.height(), .pixels = {}};
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            const auto steps = static_cast<float>(rates.exponent(x, y) - SampleRates::min_exponent);
            result.pixels.emplace_back(steps / span, 0.0f, 0.0f);
        }
    }
    return result;
}

Scale rates_scale()
{
    return {.label = "samples, in units of --spp",
            .ticks = {{0.0, "1/4"}, {0.25, "1/2"}, {0.5, "1"}, {0.75, "2"}, {1.0, "4"}}};
}

namespace {

/// Rounds to the nearest half, ties to even. `value` is not negative.
std::uint16_t to_half(float value)
{
    constexpr float greatest = 65504.0f;
    constexpr float min_normal = 6.103515625e-5f;   // 2^-14
    constexpr float subnormal_steps = 16777216.0f;  // 2^24
    if (!(value > 0.0f)) {
        return 0;
    }
    if (value >= greatest) {
        return 0x7bff;
    }
    if (value < min_normal) {
        return static_cast<std::uint16_t>(std::nearbyint(value * subnormal_steps));
    }
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t rounded = bits + 0xfffU + ((bits >> 13U) & 1U);
    constexpr std::uint32_t rebias = (127U - 15U) << 10U;
    return static_cast<std::uint16_t>((rounded >> 13U) - rebias);
}

}  // namespace

FrameHeader frame_header(const Frame& frame, ClientId client)
{
    constexpr std::uint32_t version = 3;
    const auto seen = frame.sequences.find(client);
    const std::array<std::uint32_t, frame_header_bytes / 4> numbers{
        version,          frame.slot,
        frame.generation, seen != frame.sequences.end() ? seen->second : 0,
        frame.grid_width, frame.grid_height,
        frame.x,          frame.y,
        frame.width,      frame.height,
        frame.samples,    frame.channels,
        frame.denoised};
    FrameHeader bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::uint8_t>(numbers[i / 4] >> (8 * (i % 4)));
    }
    return bytes;
}

std::vector<std::uint8_t> half_pixels(const Image& image, const Cover& cover)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * (cover.alpha.empty() ? 6 : 10));
    const auto add = [&bytes](float value) {
        const std::uint16_t half = to_half(value);
        bytes.push_back(static_cast<std::uint8_t>(half));
        bytes.push_back(static_cast<std::uint8_t>(half >> 8U));
    };
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            add(image.pixels[i][channel]);
        }
        if (!cover.alpha.empty()) {
            add(cover.shadow.empty() ? cover.alpha[i] : cover.alpha[i] - cover.shadow[i]);
            add(1.0f - cover.alpha[i]);
        }
    }
    return bytes;
}

}  // namespace bdpt::view
