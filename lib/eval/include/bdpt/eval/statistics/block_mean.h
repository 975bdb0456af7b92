#pragma once

/// @file
/// Estimates the error of a mean of values that depend on their neighbours.
///
/// @code{.cpp}
/// void print_mean(const bdpt::eval::ErrorMap& map)
/// {
///     const auto error = bdpt::eval::block_standard_error(map.values, map.width, map.height, 32);
///     std::cout << bdpt::eval::mean(map) << " +- " << error.value_or(0.0) << '\n';
/// }
/// @endcode

#include <bdpt/export.h>

#include <optional>
#include <span>

namespace bdpt::eval {

/// Returns the standard error of the mean of `width` x `height` values, row-major, whose neighbours
/// are correlated, as noise is by a pixel filter. It is estimated from the sums over blocks of
/// `block` x `block` values, which must be larger than the correlation length [the linearised
/// estimator for clusters, Cochran 1977, ch. 9A]. Returns none if there is only one block.
[[nodiscard]] BDPT_EXPORT std::optional<double> block_standard_error(std::span<const double> values,
                                                                     int width, int height,
                                                                     int block);

}  // namespace bdpt::eval
