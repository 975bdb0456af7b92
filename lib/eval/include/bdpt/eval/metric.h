#pragma once

/// @file
/// Measures the error of an image, as numbers and for each pixel, also as people see it (FLIP).
///
/// @code{.cpp}
/// void print_flip(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     const bdpt::eval::FlipExposures exposures = bdpt::eval::flip_exposures(reference);
///     const bdpt::eval::ErrorMap map = bdpt::eval::hdr_flip(image, reference, exposures);
///     std::cout << "HDR-FLIP " << bdpt::eval::mean(map) << '\n';
/// }
/// @endcode
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

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace bdpt::eval {

/// Error of each pixel; row-major, row 0 is the top row.
struct ErrorMap {
    int width = 0;
    int height = 0;
    std::vector<double> values;  ///< width * height

    /// Returns the error of a pixel, `x` in [0, width), `y` in [0, height).
    [[nodiscard]] double at(int x, int y) const
    {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Pixels per degree of visual angle of a 4K screen, 0.7 m wide, seen from 0.7 m [Andersson et al.
/// 2020, sec. 4].
inline constexpr double default_pixels_per_degree = 67.0206432765823;

/// Computes the difference that people perceive when two images of one size alternate on a screen,
/// from 0 (none) to 1 [Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images].
/// Pixels are linear light of an sRGB screen; they are clamped to [0, 1].
[[nodiscard]] BDPT_EXPORT ErrorMap flip(const Image& image, const Image& reference,
                                        double pixels_per_degree = default_pixels_per_degree);

/// Exposures [EV] of HDR-FLIP: `count` of them, evenly spaced from `start` to `stop`.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 1;

    /// Returns exposure `index` in [0, count).
    [[nodiscard]] double at(int index) const
    {
        return count > 1 ? start + (stop - start) * index / (count - 1) : start;
    }
};

/// Returns exposures from the one that shows the brightest pixel of `reference` at 0.85 to the one
/// that shows the median there, about one EV apart, at least two [Andersson et al. 2021,
/// Visualizing and Communicating Errors in Rendered Images, sec. 4]. A median below 2^-23 counts as
/// 2^-23. A black image has one exposure, 0 EV.
[[nodiscard]] BDPT_EXPORT FlipExposures flip_exposures(const Image& reference);

/// Computes HDR-FLIP [Andersson et al. 2021]: for each pixel the greatest `flip` over all
/// exposures, tone mapped by the ACES curve [Narkowicz 2016]. Pixels are scene-linear; negative
/// ones count as 0.
[[nodiscard]] BDPT_EXPORT ErrorMap hdr_flip(const Image& image, const Image& reference,
                                            const FlipExposures& exposures,
                                            double pixels_per_degree = default_pixels_per_degree);

/// Unit of epsilon in relative errors.
enum class EpsilonUnit : std::uint8_t {
    absolute,        ///< 1 (1 nit): for images of about unit brightness
    reference_mean,  ///< the mean of the reference: for images of any brightness
};

/// Options of metrics.
struct MetricOptions {
    double epsilon = 0.01;  ///< > 0; keeps relative errors of black pixels finite
    EpsilonUnit epsilon_unit = EpsilonUnit::absolute;
    std::optional<double> peak{};  ///< peak of PSNR, > 0; none: the reference's greatest component
    double pixels_per_degree = default_pixels_per_degree;  ///< resolution for FLIP, in [1, 1000]
    /// Exposures of HDR-FLIP; none: `flip_exposures(reference)`.
    std::optional<FlipExposures> exposures{};
    /// Exposure of LDR-FLIP [EV]; none: io::automatic_exposure(reference).
    std::optional<float> exposure{};
};

/// The options with all values that depend on the reference filled in: the same for every image
/// compared with it, so that errors are comparable.
struct MetricScale {
    double epsilon = 0.01;          ///< added to |r| in MAPE and to |x| + |r| in SMAPE
    double squared_epsilon = 0.01;  ///< added to r^2 in relMSE
    double peak = 1.0;              ///< peak of PSNR; 0 for a black reference
    double pixels_per_degree = default_pixels_per_degree;
    FlipExposures exposures;
    float exposure = 0.0f;  ///< exposure of LDR-FLIP [EV]
};

/// Computes the scale. With m the mean of the reference's components (or 1 for absolute epsilons),
/// `epsilon` is options.epsilon m and `squared_epsilon` is options.epsilon m^2. Throws `Error`:
/// usage for numbers out of range, invalid_input if the mean is needed and not positive.
[[nodiscard]] BDPT_EXPORT MetricScale make_scale(const Image& reference,
                                                 const MetricOptions& options);

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
