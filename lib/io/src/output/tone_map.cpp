#include <bdpt/io/display.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "output/srgb.h"

namespace bdpt::io {
namespace {

constexpr double middle_grey = 0.18;

/// Returns log2 of the luminance of each pixel that is neither black nor invalid, sorted.
std::vector<double> log_luminances(const Image& image)
{
    std::vector<double> result;
    result.reserve(image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        const double value =
            0.2126 * double{pixel.r} + 0.7152 * double{pixel.g} + 0.0722 * double{pixel.b};
        if (std::isfinite(value) && value > 0.0) {
            result.push_back(std::log2(value));
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

float automatic_exposure(const Image& image)
{
    const std::vector<double> logs = log_luminances(image);
    if (logs.empty()) {
        return 0.0f;
    }
    // Stray light 17 stops below the highlights is black to the eye, and must not count however
    // much of the image it fills.
    constexpr double black_below = 17.0;
    const auto first = std::lower_bound(
        logs.begin(), logs.end(), logs[(logs.size() - 1) - (logs.size() - 1) / 100] - black_below);
    const auto count = logs.end() - first;
    const auto trimmed = count / 100;
    const auto begin = first + trimmed;
    const auto end = logs.end() - trimmed;

    const double darkest = *begin;
    const double brightest = *(end - 1);
    const double average = std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
    const double range = brightest - darkest;
    // 1 for an image that is bright but for a few shadows, such as one against the sky. The
    // opposite case would darken images with a few highlights, and is left out.
    const double skew = range > 0.0 ? (2.0 * average - darkest - brightest) / range : 0.0;
    const double key = middle_grey * std::exp2(std::max(0.0, skew));
    return static_cast<float>(std::log2(key) - average);
}

std::uint8_t encode_srgb(float linear)
{
    return static_cast<std::uint8_t>(255.0f * srgb_code(linear) + 0.5f);
}

DisplayImage tone_map(const Image& image, float exposure, ToneCurve curve)
{
    TexelImage shown = to_display(image, {}, {.exposure = exposure, .curve = curve});
    return {image.width, image.height, std::move(shown.bytes)};
}

}  // namespace bdpt::io
