#include "report/image/backplate.h"

#include <bdpt/io/read_image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <system_error>
#include <vector>

namespace bdpt::app {
namespace {

/// The samples on one axis that contribute to a pixel, and their weights.
struct Taps {
    int first = 0;
    std::vector<float> weights;
};

/// Returns the taps of a pixel centred at `center` on an axis of `size` samples, of which `step`
/// cover a pixel: a tent two pixels wide, or two samples if those are larger.
Taps taps_at(double center, double step, int size)
{
    const double radius = std::max(1.0, step);
    const int first = static_cast<int>(std::floor(center - radius));
    const int last = static_cast<int>(std::ceil(center + radius));
    Taps taps{.first = std::clamp(first, 0, size - 1), .weights = {}};
    taps.weights.resize(static_cast<std::size_t>(std::clamp(last, 0, size - 1) - taps.first) + 1);
    double sum = 0.0;
    const auto weight = [&](int sample) {
        return std::max(0.0, 1.0 - std::abs(sample + 0.5 - center) / radius);
    };
    for (int sample = first; sample <= last; ++sample) {
        sum += weight(sample);
    }
    for (int sample = first; sample <= last; ++sample) {
        // The border is replicated.
        const int inside = std::clamp(sample, 0, size - 1);
        taps.weights[static_cast<std::size_t>(inside - taps.first)] +=
            static_cast<float>(weight(sample) / sum);
    }
    return taps;
}

Rgb shown(Rgb color)
{
    for (int channel = 0; channel < 3; ++channel) {
        color[channel] = color[channel] > 0.0f ? std::min(color[channel], 1.0f) : 0.0f;
    }
    return color;
}

/// Returns the weighted sum of pixels at a distance of `stride`.
Rgb weighted(const Image& image, std::size_t begin, std::size_t stride, const Taps& taps)
{
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
        sum += taps.weights[i] * image.pixels[begin + stride * i];
    }
    return sum;
}

}  // namespace

Image behind_frame(const Image& image, const io::ExrPlacement& frame, int width, int height)
{
    const double step = std::min(static_cast<double>(image.width) / frame.full_width,
                                 static_cast<double>(image.height) / frame.full_height);
    const auto taps = [step](int pixel, int pixels, int samples) {
        return taps_at(0.5 * samples + step * (pixel + 0.5 - 0.5 * pixels), step, samples);
    };
    Image clean = image;
    std::transform(clean.pixels.begin(), clean.pixels.end(), clean.pixels.begin(), shown);
    const auto samples = static_cast<std::size_t>(image.width);
    std::vector<Taps> across;
    for (int x = 0; x < width; ++x) {
        across.push_back(taps(x + frame.x, frame.full_width, image.width));
    }
    Image wide{width, image.height, {}};  // final width, original height
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
        for (const Taps& of_pixel : across) {
            wide.pixels.push_back(weighted(
                clean, y * samples + static_cast<std::size_t>(of_pixel.first), 1, of_pixel));
        }
    }
    Image result{width, height, {}};
    const auto columns = static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y) {
        const Taps down = taps(y + frame.y, frame.full_height, image.height);
        for (std::size_t x = 0; x < columns; ++x) {
            result.pixels.push_back(
                weighted(wide, static_cast<std::size_t>(down.first) * columns + x, columns, down));
        }
    }
    return result;
}

std::optional<Image> backplate(const DisplayArguments& display, const Image& image,
                               const std::optional<io::ExrPlacement>& frame)
{
    if (!display.backdrop || display.backdrop->photo.empty()) {
        return std::nullopt;
    }
    const io::ExrPlacement whole{.full_width = image.width, .full_height = image.height};
    return behind_frame(io::read_image(display.backdrop->photo).image, frame.value_or(whole),
                        image.width, image.height);
}

void check_backplate(const DisplayArguments& display)
{
    if (display.backdrop && !display.backdrop->photo.empty()) {
        static_cast<void>(io::read_image(display.backdrop->photo));
    }
}

std::filesystem::path find_photo(const std::filesystem::path& named,
                                 const std::filesystem::path& image)
{
    std::error_code ignored;
    const std::filesystem::path beside = image.parent_path() / named;
    return !exists(named, ignored) && exists(beside, ignored) ? beside : named;
}

}  // namespace bdpt::app
