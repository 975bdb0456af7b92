#pragma once

#include "catch.hpp"
#include "chi_square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::test {

/// Returns the bin of numbers in [0, 1) in a grid of `steps` for each; numbers that rounding moved
/// out of range count with their neighbours.
template <std::size_t N>
[[nodiscard]] std::size_t find_bin(const std::array<double, N>& numbers, int steps)
{
    std::size_t bin = 0;
    for (const double x : numbers) {
        const int step = std::clamp(static_cast<int>(x * steps), 0, steps - 1);
        bin = bin * static_cast<std::size_t>(steps) + static_cast<std::size_t>(step);
    }
    return bin;
}

/// Returns the angle of (x, y) as a fraction of the full circle.
[[nodiscard]] inline double turn(double x, double y)
{
    return 0.5 + std::atan2(y, x) / 6.283185307179586;
}

/// Fails unless the counts agree with these probabilities, by a test that would see an error of 3 %
/// of the density.
inline void check_counts(const std::vector<double>& counts,
                         const std::vector<double>& probabilities)
{
    constexpr double significance = 1e-4;
    constexpr double visible_error = 0.03;
    const ChiSquare result = chi_square(counts, probabilities);
    INFO("chi^2 " << result.statistic << " of " << result.degrees);
    CHECK(result.p_value > significance);
    CHECK(result.min_detectable(significance) < visible_error);
}

inline void check_uniform(const std::vector<double>& counts)
{
    check_counts(counts,
                 std::vector<double>(counts.size(), 1.0 / static_cast<double>(counts.size())));
}

}  // namespace bdpt::test
