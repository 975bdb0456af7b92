#pragma once

#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace bdpt::test {

/// Result of Pearson's test of counts against probabilities.
struct ChiSquare {
    double statistic = 0.0;
    int degrees = 0;
    double p_value = 0.0;
    double samples = 0.0;

    /// Returns the smallest relative error of the probabilities (up in half of the bins' mass, down
    /// in the other half) that a test of this `significance` finds with probability 0.998. A test
    /// without the power to see relevant errors must fail.
    [[nodiscard]] double min_detectable(double significance) const
    {
        double low = 0.0;
        double high = 100.0 * degrees + 1000.0;
        for (int i = 0; i < 200; ++i) {
            const double middle = 0.5 * (low + high);
            (upper_gamma(0.5 * degrees, 0.5 * middle) > significance ? low : high) = middle;
        }
        // An error e adds n e^2 to the statistic's mean; its variance is 2 k + 4 n e^2. Requires
        // three standard deviations above the critical value: a quadratic equation in sqrt(n e^2).
        const double excess = high - degrees;
        double added = excess;
        for (int i = 0; i < 100; ++i) {
            added = excess + 3.0 * std::sqrt(2.0 * degrees + 4.0 * added);
        }
        return std::sqrt(added / samples);
    }
};

/// Compares counts with their expected probabilities, which sum to one. Bins with fewer than five
/// expected counts are pooled, the rarest first; a count in a bin of probability 0 makes the
/// p-value zero.
[[nodiscard]] inline ChiSquare chi_square(std::span<const double> counts,
                                          std::span<const double> probabilities)
{
    const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
    std::vector<std::size_t> order(counts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
    constexpr double min_expected = 5.0;
    ChiSquare result;
    result.samples = total;
    double pooled_count = 0.0;
    double pooled_expected = 0.0;
    int bins = 0;
    for (const std::size_t i : order) {
        if (probabilities[i] <= 0.0 && counts[i] > 0.0) {
            return result;
        }
        pooled_count += counts[i];
        pooled_expected += std::max(0.0, probabilities[i]) * total;
        if (pooled_expected < min_expected) {
            continue;
        }
        const double difference = pooled_count - pooled_expected;
        result.statistic += difference * difference / pooled_expected;
        pooled_count = 0.0;
        pooled_expected = 0.0;
        ++bins;
    }
    result.degrees = bins - 1;
    if (result.degrees >= 1) {
        result.p_value = upper_gamma(0.5 * result.degrees, 0.5 * result.statistic);
    }
    return result;
}

}  // namespace bdpt::test
