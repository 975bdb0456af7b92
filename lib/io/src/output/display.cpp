#include <bdpt/io/display.h>

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "output/srgb.h"

namespace bdpt::io {
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
