#pragma once

#include "verify/compare_means.h"
#include "verify/evidence.h"

#include <cstddef>

namespace bdpt::eval {

/// Compares the tested estimate of a strategy with the expected one, in a cell.
[[nodiscard]] MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell,
                                              std::size_t index);

/// Compares one of `other_integrators` with the paths of bdpt that it can sample, in a cell.
[[nodiscard]] MeanComparison compare_integrator(const Evidence& evidence, std::size_t cell,
                                                int edges, std::size_t integrator);

/// Compares the tested estimate of merging with the expected one, in the whole image.
[[nodiscard]] MeanComparison compare_merges(const Evidence& evidence, int edges);

}  // namespace bdpt::eval
