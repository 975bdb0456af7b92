#pragma once

#include <bdpt/path_contribution.h>
#include <bdpt/types.h>

#include <array>
#include <cstdint>

namespace bdpt::eval {

/// The number that stands for a colour in a comparison of means.
enum class Measure : std::uint8_t { red, green, blue, mean };

/// A mistake may move light from one channel to another and leave the mean of all as it is.
constexpr std::array<Measure, 3> channel_measures{Measure::red, Measure::green, Measure::blue};

[[nodiscard]] inline double measured(Measure measure, Rgb c)
{
    return measure == Measure::mean
               ? (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) /
                     3.0
               : static_cast<double>(c[static_cast<int>(measure)]);
}

/// Edges of a path; where it was merged, two vertices are one.
[[nodiscard]] inline int edges_of(const PathContribution& path)
{
    return path.strategy.s + path.strategy.t - (path.merged ? 2 : 1);
}

}  // namespace bdpt::eval
