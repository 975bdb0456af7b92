#include <bdpt/eval/metric.h>

#include <bdpt/error.h>
#include <bdpt/eval/drawing.h>
#include <bdpt/io/display.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>

#include "metrics/metric_parts.h"

namespace bdpt::eval {

namespace {

std::string size_text(const Image& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

}  // namespace

void check_image(const NamedInput& input)
{
    constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
    if (input.image.pixels.empty()) {
        throw Error(ErrorCode::invalid_input, input.name + ": has no pixels");
    }
    for (int y = 0; y < input.image.height; ++y) {
        for (int x = 0; x < input.image.width; ++x) {
            for (std::size_t c = 0; c < channels.size(); ++c) {
                const float value = input.image.at(x, y)[static_cast<int>(c)];
                if (!std::isfinite(value)) {
                    throw Error(ErrorCode::invalid_input,
                                input.name + ": pixel (" + std::to_string(input.x0 + x) + ", " +
                                    std::to_string(input.y0 + y) + ") has " +
                                    std::to_string(value) + " in channel " + channels[c]);
                }
            }
        }
    }
}

void check_same_size(const NamedInput& input, const NamedInput& reference)
{
    if (input.image.width != reference.image.width ||
        input.image.height != reference.image.height) {
        throw Error(ErrorCode::invalid_input, input.name + ": has " + size_text(input.image) +
                                                  " pixels, but " + reference.name + " has " +
                                                  size_text(reference.image));
    }
}

void check_image(const NamedInput& input, const NamedInput& reference)
{
    check_same_size(input, reference);
    check_image(input);
}

namespace {

void check(bool good, const std::string& message)
{
    if (!good) {
        throw Error(ErrorCode::usage, message);
    }
}

bool is_positive(double value)
{
    return std::isfinite(value) && value > 0.0;
}

void check_options(const MetricOptions& options)
{
    check(is_positive(options.epsilon),
          "epsilon " + std::to_string(options.epsilon) + ": must be a number greater than 0");
    check(!options.peak || is_positive(*options.peak), "peak: must be a number greater than 0");
    check(options.pixels_per_degree >= 1.0 && options.pixels_per_degree <= 1000.0,
          "pixels per degree " + std::to_string(options.pixels_per_degree) +
              ": must be from 1 to 1000");
    if (options.exposures) {
        const FlipExposures& e = *options.exposures;
        check(e.count >= 1 && std::isfinite(e.start) && std::isfinite(e.stop) &&
                  e.start <= e.stop && (e.count >= 2 || e.start == e.stop),
              "exposures of FLIP: " + std::to_string(e.count) + " from " + std::to_string(e.start) +
                  " to " + std::to_string(e.stop) + " EV are not a valid range");
    }
}

double compute_mean(const Image& image)
{
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) {
        sum += static_cast<double>(pixel.r) + static_cast<double>(pixel.g) +
               static_cast<double>(pixel.b);
    }
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

double max_value(const Image& image)
{
    float greatest = 0.0f;
    for (const Rgb& pixel : image.pixels) {
        greatest = std::max({greatest, pixel.r, pixel.g, pixel.b});
    }
    return static_cast<double>(greatest);
}

}  // namespace

MetricScale make_scale(const Image& reference, const MetricOptions& options)
{
    check_options(options);
    double unit = 1.0;
    if (options.epsilon_unit == EpsilonUnit::reference_mean) {
        unit = compute_mean(reference);
        if (!(unit > 0.0)) {
            throw Error(ErrorCode::invalid_input, "the reference's mean is " +
                                                      std::to_string(unit) +
                                                      ", so errors cannot be relative to it");
        }
    }
    return {.epsilon = options.epsilon * unit,
            .squared_epsilon = options.epsilon * unit * unit,
            .peak = options.peak.value_or(max_value(reference)),
            .pixels_per_degree = options.pixels_per_degree,
            .exposures = options.exposures ? *options.exposures : flip_exposures(reference),
            .exposure = options.exposure ? *options.exposure : io::automatic_exposure(reference)};
}

namespace {

/// Returns the mean over the channels of `term(x, r)`, for each pixel.
template <typename Term>
ErrorMap channel_means(const Image& image, const Image& reference, Term term)
{
    ErrorMap map{image.width, image.height, {}};
    map.values.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        double sum = 0.0;
        for (int c = 0; c < 3; ++c) {
            sum += term(static_cast<double>(image.pixels[i][c]),
                        static_cast<double>(reference.pixels[i][c]));
        }
        map.values.push_back(sum / 3.0);
    }
    return map;
}

ErrorMap relative_squares(const Image& image, const Image& reference, const MetricScale& scale)
{
    return channel_means(image, reference, [&scale](double x, double r) {
        return (x - r) * (x - r) / (r * r + scale.squared_epsilon);
    });
}

/// Returns for each pixel the mean over all scales of the square that contains it.
ErrorMap relative_squares_at_scales(const Image& image, const Image& reference,
                                    const MetricScale& scale)
{
    constexpr std::array sides{2, 4, 8, 16};
    constexpr double scales = 1.0 + sides.size();
    ErrorMap map = relative_squares(image, reference, scale);
    for (const int side : sides) {
        const ErrorMap coarse =
            relative_squares(shrunk(image, side), shrunk(reference, side), scale);
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
                map.values[row + static_cast<std::size_t>(x)] += coarse.at(x / side, y / side);
            }
        }
    }
    for (double& value : map.values) {
        value /= scales;
    }
    return map;
}

/// Returns the image as `bdpt render` shows it in a PNG file, in linear light.
Image on_screen(const Image& image, float exposure)
{
    Image result = image;
    const float factor = std::exp2(exposure);
    for (Rgb& pixel : result.pixels) {
        pixel = io::filmic(factor * pixel);
    }
    return result;
}

}  // namespace

std::string_view to_string(Metric metric)
{
    constexpr std::array<std::string_view, all_metrics.size()> names{
        "relmse", "relmse_scales", "mse", "rmse", "mape", "smape", "psnr", "flip", "flip_ldr"};
    return names[static_cast<std::size_t>(metric)];
}

std::optional<Metric> parse_metric(std::string_view name)
{
    const auto found = std::find_if(all_metrics.begin(), all_metrics.end(),
                                    [name](Metric metric) { return to_string(metric) == name; });
    return found != all_metrics.end() ? std::optional(*found) : std::nullopt;
}

bool grows_with_error(Metric metric)
{
    return metric != Metric::psnr;
}

ErrorMap error_terms(Metric metric, const Image& image, const Image& reference,
                     const MetricScale& scale)
{
    switch (metric) {
        case Metric::relmse:
            return relative_squares(image, reference, scale);
        case Metric::relmse_scales:
            return relative_squares_at_scales(image, reference, scale);
        case Metric::mse:
        case Metric::rmse:
        case Metric::psnr:
            return channel_means(image, reference,
                                 [](double x, double r) { return (x - r) * (x - r); });
        case Metric::mape:
            return channel_means(image, reference, [&scale](double x, double r) {
                return std::abs(x - r) / (std::abs(r) + scale.epsilon);
            });
        case Metric::smape:
            return channel_means(image, reference, [&scale](double x, double r) {
                return std::abs(x - r) / (std::abs(x) + std::abs(r) + scale.epsilon);
            });
        case Metric::flip:
            return hdr_flip(image, reference, scale.exposures, scale.pixels_per_degree);
        case Metric::flip_ldr:
            return flip(on_screen(image, scale.exposure), on_screen(reference, scale.exposure),
                        scale.pixels_per_degree);
    }
    return {};
}

double from_mean(Metric metric, double mean, const MetricScale& scale)
{
    if (metric == Metric::rmse) {
        return std::sqrt(mean);
    }
    if (metric == Metric::psnr) {
        return mean > 0.0 ? 10.0 * std::log10(scale.peak * scale.peak / mean)
                          : std::numeric_limits<double>::infinity();
    }
    return mean;
}

double mean(const ErrorMap& map)
{
    return std::accumulate(map.values.begin(), map.values.end(), 0.0) /
           static_cast<double>(map.values.size());
}

double evaluate(Metric metric, const Image& image, const Image& reference,
                const MetricOptions& options)
{
    const NamedInput truth{.name = "the reference", .image = reference};
    check_image(truth);
    check_image({.name = "the image", .image = image}, truth);
    const MetricScale scale = make_scale(reference, options);
    return from_mean(metric, mean(error_terms(metric, image, reference, scale)), scale);
}

}  // namespace bdpt::eval
