#pragma once

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
