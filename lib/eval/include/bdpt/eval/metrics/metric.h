#pragma once

/// @file
/// Measures the error of an image.
///
/// @code{.cpp}
/// void print_errors(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     for (const bdpt::eval::Metric metric : bdpt::eval::all_metrics) {
///         const double error = bdpt::eval::evaluate(metric, image, reference);
///         std::cout << bdpt::eval::to_string(metric) << ' ' << error << '\n';
///     }
/// }
/// @endcode

#include <bdpt/eval/metrics/error_map.h>
#include <bdpt/eval/metrics/metric_scale.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace bdpt::eval {

/// A measure of the error of an image x against its reference r. Means are over pixels and
/// channels.
enum class Metric : std::uint8_t {
    relmse,  ///< mean of (x - r)^2 / (r^2 + squared_epsilon)
    /// Mean of relmse and of the relmse of averages over squares of 2, 4, 8 and 16 pixels a side,
    /// so that correlated errors count more than those that average out.
    relmse_scales,
    mse,       ///< mean of (x - r)^2
    rmse,      ///< root of mse
    mape,      ///< mean of |x - r| / (|r| + epsilon)
    smape,     ///< mean of |x - r| / (|x| + |r| + epsilon) [Vogels et al. 2018]
    psnr,      ///< 10 log10(peak^2 / mse) [dB]; infinite without an error; greater is better
    flip,      ///< mean of HDR-FLIP
    flip_ldr,  ///< mean of FLIP between the images as tone-mapped by `io::filmic`
};

/// All metrics, in the order of the enumerators.
inline constexpr std::array all_metrics{Metric::relmse, Metric::relmse_scales, Metric::mse,
                                        Metric::rmse,   Metric::mape,          Metric::smape,
                                        Metric::psnr,   Metric::flip,          Metric::flip_ldr};

/// Returns the enumerator's own name.
[[nodiscard]] BDPT_EXPORT std::string_view to_string(Metric metric);
/// Returns the enumerator of that name, if there is one.
[[nodiscard]] BDPT_EXPORT std::optional<Metric> parse_metric(std::string_view name);

/// Tests whether a greater value means a greater error: true for all but psnr.
[[nodiscard]] BDPT_EXPORT bool grows_with_error(Metric metric);

/// Returns the terms that the metric averages: for each pixel the mean over its channels, before
/// any root or logarithm; mse, rmse and psnr have the same terms. The images have one size and are
/// finite.
[[nodiscard]] BDPT_EXPORT ErrorMap error_terms(Metric metric, const Image& image,
                                               const Image& reference, const MetricScale& scale);

/// Returns the metric, given the mean of its terms.
[[nodiscard]] BDPT_EXPORT double from_mean(Metric metric, double mean, const MetricScale& scale);

/// Returns the mean of the values, of which there is at least one.
[[nodiscard]] BDPT_EXPORT double mean(const ErrorMap& map);

/// Evaluates the metric of a whole image. Throws `Error`: invalid_input for images without pixels,
/// of different sizes, or with NaN or infinity; usage for invalid options.
[[nodiscard]] BDPT_EXPORT double evaluate(Metric metric, const Image& image, const Image& reference,
                                          const MetricOptions& options = {});

}  // namespace bdpt::eval
