#pragma once

#include "verify/compare_means.h"
#include "verify/evidence.h"

#include <cstddef>

namespace bdpt::eval {

/// What a strategy found against what is expected of it, in a cell.
[[nodiscard]] MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell,
                                              std::size_t index);

/// One of `other_integrators` against the paths of bdpt that it can make, in a cell.
[[nodiscard]] MeanComparison compare_integrator(const Evidence& evidence, std::size_t cell,
                                                int edges, std::size_t integrator);

/// What merging found against what is expected of it, in the whole image.
[[nodiscard]] MeanComparison compare_merges(const Evidence& evidence, int edges);

}  // namespace bdpt::eval
