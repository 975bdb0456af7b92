#include <bdpt/io/display.h>

#include <bdpt/error.h>
#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "output/image_output.h"

namespace bdpt::io {

namespace {

/// Makes a colour finite and non-negative; NaN becomes 0.
Rgb sound(Rgb color)
{
    // Far above the end of any curve; keeps squares finite.
    constexpr float brightest = 1e6f;
    for (int channel = 0; channel < 3; ++channel) {
        color[channel] = color[channel] > 0.0f ? std::min(color[channel], brightest) : 0.0f;
    }
    return color;
}

float largest(Rgb color)
{
    return std::max(color.r, std::max(color.g, color.b));
}

/// Evaluates Narkowicz' fit of the ACES reference transform; reaches 1 at about 7.2.
float film_curve(float x)
{
    return std::min(1.0f, (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f));
}

/// Evaluates Wrensch's fit of the contrast curve of AgX, from [0, 1].
Rgb agx_curve(Rgb x)
{
    constexpr float coefficients[]{15.5f, -40.14f, 31.96f, -6.868f, 0.4298f, 0.1191f, -0.00232f};
    Rgb sum(0.0f);
    for (const float coefficient : coefficients) {
        sum = sum * x + coefficient;
    }
    return sum;
}

}  // namespace

std::string_view tone_curve_name(ToneCurve curve)
{
    constexpr std::array<std::string_view, all_tone_curves.size()> names{"filmic", "pbr-neutral",
                                                                         "agx", "none"};
    return names[static_cast<std::size_t>(curve)];
}

Rgb filmic(Rgb scene_linear)
{
    // Rate at which colours above 1 fade to white, as film loses them, too.
    constexpr float fade = 0.15f;

    const Rgb color = sound(scene_linear);
    const float peak = largest(color);
    if (peak <= 0.0f) {
        return Rgb(0.0f);
    }
    const float excess = fade * std::max(0.0f, peak - 1.0f);
    const float white = excess / (1.0f + excess);
    const Rgb hue = color / peak;
    return film_curve(peak) * (hue * (1.0f - white) + Rgb(white));
}

Rgb pbr_neutral(Rgb scene_linear)
{
    constexpr float fresnel = 0.04f;  // reflectance of a dielectric of index 1.5
    constexpr float start = 0.8f - fresnel;
    constexpr float room = 1.0f - start;
    constexpr float fade = 0.15f;

    Rgb color = sound(scene_linear);
    // Dark colours lose less than the full offset, as they must not become negative.
    const float least = std::min(color.r, std::min(color.g, color.b));
    color -= least < 2.0f * fresnel ? least - least * least / (4.0f * fresnel) : fresnel;
    const float peak = largest(color);
    if (peak < start) {
        return color;
    }
    const float compressed = 1.0f - room * room / (peak + room - start);
    const float white = 1.0f - 1.0f / (fade * (peak - compressed) + 1.0f);
    return mix(color * (compressed / peak), Rgb(compressed), white);
}

Rgb agx(Rgb scene_linear)
{
    // Columns.
    const Mat3 rec2020_from_rec709(0.6274f, 0.0691f, 0.0164f, 0.3293f, 0.9195f, 0.0880f, 0.0433f,
                                   0.0113f, 0.8956f);
    const Mat3 rec709_from_rec2020(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f,
                                   -0.0728f, -0.0083f, 1.1187f);
    // Primaries are moved inwards, so that bright colours fade, and back.
    const Mat3 inset(0.856627153f, 0.137318973f, 0.111898213f, 0.0951212405f, 0.761241991f,
                     0.0767994186f, 0.0482516061f, 0.101439036f, 0.811302368f);
    const Mat3 outset(1.12710058f, -0.141329763f, -0.141329763f, -0.110606643f, 1.15782370f,
                      -0.110606643f, -0.0164939387f, -0.0164939387f, 1.25193641f);
    // The range of the curve [EV].
    constexpr float darkest = -12.47393f;
    constexpr float brightest = 4.026069f;

    const Rgb color = inset * (rec2020_from_rec709 * sound(scene_linear));
    const Rgb stops = log2(max(color, Rgb(1e-10f)));
    const Rgb range = clamp((stops - darkest) / (brightest - darkest), 0.0f, 1.0f);
    // The curve's output is encoded with a power of 2.2.
    const Rgb linear = pow(max(outset * agx_curve(range), Rgb(0.0f)), Rgb(2.2f));
    return clamp(rec709_from_rec2020 * linear, 0.0f, 1.0f);
}

Rgb apply(ToneCurve curve, Rgb scene_linear)
{
    switch (curve) {
        case ToneCurve::filmic:
            return filmic(scene_linear);
        case ToneCurve::pbr_neutral:
            return pbr_neutral(scene_linear);
        case ToneCurve::agx:
            return agx(scene_linear);
        case ToneCurve::none:
            break;
    }
    return min(sound(scene_linear), Rgb(1.0f));
}

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

namespace {

/// Appends codes in [0, 1] to the bytes of an image.
class CodeWriter {
public:
    explicit CodeWriter(TexelImage& image) : image_(image) {}

    void add(float code)
    {
        if (image_.type == TexelType::unorm8) {
            image_.bytes.push_back(static_cast<std::uint8_t>(255.0f * code + 0.5f));
            return;
        }
        const auto value = static_cast<std::uint16_t>(65535.0f * code + 0.5f);
        std::uint8_t bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        image_.bytes.insert(image_.bytes.end(), bytes, bytes + sizeof value);
    }
    void add_color(Rgb linear)
    {
        for (int channel = 0; channel < 3; ++channel) {
            add(srgb_code(linear[channel]));
        }
    }

private:
    TexelImage& image_;
};

void check(const Image& image, std::span<const float> coverage, const DisplayOptions& options)
{
    const TexelType type = options.type;
    if (!options.shadow.empty() && options.shadow.size() != coverage.size()) {
        throw Error(ErrorCode::usage, fmt::format("{} values of alpha with {} of a shadow",
                                                  coverage.size(), options.shadow.size()));
    }
    if (!coverage.empty() && coverage.size() != image.pixels.size()) {
        throw Error(ErrorCode::usage, fmt::format("an image of {} pixels with {} values of alpha",
                                                  image.pixels.size(), coverage.size()));
    }
    const Image* plate = options.backplate;
    if (plate != nullptr && (plate->width != image.width || plate->height != image.height)) {
        throw Error(ErrorCode::usage,
                    fmt::format("an image of {} x {} pixels before a backplate of {} x {}",
                                image.width, image.height, plate->width, plate->height));
    }
    if (type != TexelType::unorm8 && type != TexelType::unorm16) {
        throw Error(ErrorCode::usage, "images for screens have integers of 8 or 16 bits");
    }
}

}  // namespace

TexelImage to_display(const Image& image, std::span<const float> coverage,
                      const DisplayOptions& options)
{
    check(image, coverage, options);
    const double gain = std::exp2(double{options.exposure});
    // Returns the display pixel, if `alpha` of it is covered with its colour.
    const auto shown = [&](Rgb pixel, float alpha) {
        constexpr double brightest = 1e30;  // white at any exposure, and a float
        for (int channel = 0; channel < 3; ++channel) {
            const double value = double{pixel[channel]} * gain / double{alpha};
            pixel[channel] = static_cast<float>(std::min(value, brightest));
        }
        return apply(options.curve, pixel);
    };
    const bool opaque = coverage.empty();
    const bool has_alpha = !opaque && !options.background && options.backplate == nullptr;
    Rgb background(0.0f);
    for (std::size_t channel = 0; channel < 3 && options.background; ++channel) {
        background[static_cast<int>(channel)] =
            srgb_linear(static_cast<float>((*options.background)[channel]) / 255.0f);
    }
    TexelImage result{.width = image.width,
                      .height = image.height,
                      .bytes = {},
                      .channels = has_alpha ? 4 : 3,
                      .type = options.type};
    result.bytes.reserve(image.pixels.size() * static_cast<std::size_t>(result.channels) *
                         count_value_bytes(options.type));
    CodeWriter codes(result);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float alpha = opaque ? 1.0f : coverage[i] > 0.0f ? std::min(coverage[i], 1.0f) : 0.0f;
        const float own =
            options.shadow.empty() ? alpha : std::max(alpha - options.shadow[i], 0.0f);
        const Rgb color = own > 0.0f ? shown(image.pixels[i], own) : Rgb(0.0f);
        if (has_alpha) {
            codes.add_color(own > 0.0f ? own / alpha * color : color);
            codes.add(alpha);
        } else {
            const Rgb behind =
                options.backplate != nullptr ? options.backplate->pixels[i] : background;
            codes.add_color(opaque ? color : own * color + (1.0f - alpha) * behind);
        }
    }
    return result;
}

}  // namespace bdpt::io
