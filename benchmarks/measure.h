#pragma once

#include <bdpt/eval/statistics/spread.h>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace bdpt {

/// Returns the median of at least one number.
[[nodiscard]] inline double median(std::vector<double> values)
{
    return eval::spread(std::move(values)).median;
}

/// Returns the results of `run(variant, round)` for each variant, by round. Runs are interleaved (A
/// B C A B C ...), so that a machine that slows down does so for all variants.
template <typename Run>
[[nodiscard]] auto in_turn(std::size_t variants, int rounds, const Run& run)
{
    using Result = std::invoke_result_t<Run, std::size_t, int>;
    std::vector<std::vector<Result>> results(variants);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t variant = 0; variant < variants; ++variant) {
            results[variant].push_back(run(variant, round));
        }
    }
    return results;
}

/// Returns the median over rounds of the ratio of `a` to `b` in the same round.
[[nodiscard]] inline double median_ratio(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ratios.push_back(a[i] / b[i]);
    }
    return median(std::move(ratios));
}

}  // namespace bdpt
