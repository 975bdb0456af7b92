#pragma once

/// @file
/// Fixes the scale of errors for all images that are compared with a reference.
///
/// @code{.cpp}
/// bdpt::eval::MetricScale scale_of(const bdpt::Image& reference)
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

/// The reference of the small number in the denominator of relative errors.
enum class EpsilonUnit : std::uint8_t {
    absolute,        ///< 1, or 1 nit: images of about unit brightness
    reference_mean,  ///< the mean of the reference: images of any brightness
};

/// The parameters of metrics beside the two images.
struct MetricOptions {
    double epsilon = 0.01;  ///< > 0; keeps relative errors of black pixels finite
    EpsilonUnit epsilon_unit = EpsilonUnit::absolute;
    std::optional<double> peak{};  ///< of PSNR, > 0; none: the reference's greatest component
    double pixels_per_degree = default_pixels_per_degree;  ///< of FLIP; 1 to 1000
    std::optional<FlipExposures> exposures{};  ///< of HDR-FLIP; none: those that suit the reference
    std::optional<float> exposure{};  ///< [EV] of LDR-FLIP; none: io::automatic_exposure(reference)
};

/// The options with all that depends on the reference filled in: the same for every image that is
/// held against it, so that their errors can be compared.
struct MetricScale {
    double epsilon = 0.01;          ///< added to |r| in MAPE and to |x| + |r| in SMAPE
    double squared_epsilon = 0.01;  ///< added to r^2 in relMSE
    double peak = 1.0;              ///< 0 for a black reference
    double pixels_per_degree = default_pixels_per_degree;
    FlipExposures exposures;
    float exposure = 0.0f;  ///< [EV]
};

/// With m the mean of the reference's components (or 1 for absolute epsilons), `epsilon` is
/// options.epsilon m and `squared_epsilon` options.epsilon m^2. Throws `Error`: usage for numbers
/// out of range, invalid_input when the mean is needed and not positive.
[[nodiscard]] BDPT_EXPORT MetricScale make_scale(const Image& reference,
                                                 const MetricOptions& options);

}  // namespace bdpt::eval
