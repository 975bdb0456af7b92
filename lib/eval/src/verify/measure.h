#pragma once

#include <bdpt/path_contribution.h>
#include <bdpt/types.h>

#include <array>
#include <cstdint>

namespace bdpt::eval {

/// The scalar that represents a colour in a comparison of means.
enum class Measure : std::uint8_t { red, green, blue, mean };

/// Per-channel measures: a mistake may move light from one channel to another and preserve the
/// mean.
constexpr std::array<Measure, 3> channel_measures{Measure::red, Measure::green, Measure::blue};

[[nodiscard]] inline double measured(Measure measure, Rgb c)
{
    return measure == Measure::mean
               ? (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) /
                     3.0
               : static_cast<double>(c[static_cast<int>(measure)]);
}

/// Returns the edges of a path; the two vertices of a merge count as one.
[[nodiscard]] inline int count_edges(const PathContribution& path)
{
    return path.strategy.s + path.strategy.t - (path.merged ? 2 : 1);
}

}  // namespace bdpt::eval
