#include <bdpt/error.h>
#include <bdpt/eval/metric.h>
#include <bdpt/io/display.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace bdpt::eval {
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

}  // namespace bdpt::eval
