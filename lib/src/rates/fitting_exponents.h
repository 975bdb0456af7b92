#pragma once

#include "rates/plane.h"

#include <bdpt/part/sample_rates.h>

#include <cstdint>
#include <vector>

namespace bdpt {

/// Inclusive range, within that of `SampleRates`.
struct ExponentRange {
    int min = SampleRates::min_exponent;
    int max = SampleRates::max_exponent;
};

/// Returns exponents of rates that are in proportion to `wanted`, whose values must be positive.
/// Element i counts `pixels[i]` times, or once if `pixels` is empty. The mean rate is at most 1,
/// and raising one more element would exceed that, unless all have the greatest in `range`.
[[nodiscard]] std::vector<std::int8_t> fitting_exponents(const Plane& wanted,
                                                         const std::vector<std::int64_t>& pixels,
                                                         ExponentRange range = {});

}  // namespace bdpt
