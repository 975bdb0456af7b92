#pragma once

/// @file
/// Finds the error that stays however long an integrator renders.
///
/// @code{.cpp}
/// void print_floor(std::span<const bdpt::Image> seeds, const bdpt::eval::Reference& reference)
/// {
///     const auto floor = bdpt::eval::error_floor(seeds, reference.image, reference.noise);
///     std::cout << "error floor: " << floor.value_or(0.0) << '\n';
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <optional>
#include <span>

namespace bdpt::eval {

/// Returns the part of the relMSE that is common to renders with different seeds. It remains
/// however long one renders: it is the light that an integrator cannot find. It is estimated from
/// products of the errors of two different renders, in which noise cancels; `noise` is that of the
/// reference. Returns none if it is less than a tenth of the error, or less than three standard
/// errors from 0. Takes at least two images of the reference's size.
[[nodiscard]] BDPT_EXPORT std::optional<double> error_floor(std::span<const Image> images,
                                                            const Image& reference, double noise);

}  // namespace bdpt::eval
