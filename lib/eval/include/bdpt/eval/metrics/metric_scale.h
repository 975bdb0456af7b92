#pragma once

/// @file
/// Fixes the scale of errors for all images that are compared with a reference.
///
/// @code{.cpp}
/// bdpt::eval::MetricScale make_relative_scale(const bdpt::Image& reference)
/// {
///     bdpt::eval::MetricOptions options;
///     options.epsilon_unit = bdpt::eval::EpsilonUnit::reference_mean;
///     return bdpt::eval::make_scale(reference, options);
/// }
/// @endcode

#include <bdpt/eval/metrics/flip.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstdint>
#include <optional>

namespace bdpt::eval {

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

}  // namespace bdpt::eval
