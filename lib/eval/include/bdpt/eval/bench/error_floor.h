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

/// The part of the relMSE of some renders, with different seeds, that is the same in all of them:
/// it stays however long one renders, as what an integrator cannot find is missing each time. From
/// products of the errors of two different renders, in which noise cancels; `noise` is that of the
/// reference. None when it is less than a tenth of the error, or not sure: closer to 0 than three
/// standard errors. At least two images of the reference's size.
[[nodiscard]] BDPT_EXPORT std::optional<double> error_floor(std::span<const Image> images,
                                                            const Image& reference, double noise);

}  // namespace bdpt::eval
