#include <bdpt/io/tone_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace bdpt::io {
namespace {

constexpr double middle_grey = 0.18;

/// log2 of the luminance of each pixel that shows something, sorted.
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

/// NaN, too, becomes 0.
float at_least_zero(float value)
{
    return value > 0.0f ? value : 0.0f;
}

/// Narkowicz' fit of the ACES reference transform; reaches 1 at about 7.2.
float curve(float x)
{
    return std::min(1.0f, (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f));
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
    // 1 for an image that is bright but for a few shadows, as one against the sky is. The reverse
    // would darken images with a few highlights, and is left out.
    const double skew = range > 0.0 ? (2.0 * average - darkest - brightest) / range : 0.0;
    const double key = middle_grey * std::exp2(std::max(0.0, skew));
    return static_cast<float>(std::log2(key) - average);
}

Rgb filmic(Rgb scene_linear)
{
    // Far above the curve's end; keeps its squares finite.
    constexpr float brightest = 1e6f;
    // How fast colours fade above 1, where film loses them too.
    constexpr float fade = 0.15f;

    const Rgb color(std::min(at_least_zero(scene_linear.r), brightest),
                    std::min(at_least_zero(scene_linear.g), brightest),
                    std::min(at_least_zero(scene_linear.b), brightest));
    const float peak = std::max(color.r, std::max(color.g, color.b));
    if (peak <= 0.0f) {
        return Rgb(0.0f);
    }
    const float excess = fade * std::max(0.0f, peak - 1.0f);
    const float white = excess / (1.0f + excess);
    const Rgb hue = color / peak;
    return curve(peak) * (hue * (1.0f - white) + Rgb(white));
}

std::uint8_t encode_srgb(float linear)
{
    const float value = std::min(at_least_zero(linear), 1.0f);
    const float encoded =
        value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(255.0f * encoded + 0.5f);
}

DisplayImage tone_map(const Image& image, float exposure)
{
    const double gain = std::exp2(double{exposure});
    const auto scale = [gain](float value) {
        constexpr double brightest = 1e30;  // white at any exposure, and a float
        return static_cast<float>(std::min(double{value} * gain, brightest));
    };
    DisplayImage result{image.width, image.height, {}};
    result.rgb.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        const Rgb display = filmic(Rgb(scale(pixel.r), scale(pixel.g), scale(pixel.b)));
        for (int channel = 0; channel < 3; ++channel) {
            result.rgb.push_back(encode_srgb(display[channel]));
        }
    }
    return result;
}

}  // namespace bdpt::io
