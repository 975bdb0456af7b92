#pragma once

#include "pilot/pilot_errors.h"

#include <bdpt/part/sample_rates.h>

#include <cstddef>
#include <memory>

namespace bdpt {

/// Returns rates of samples from 1/2 to 2 for a render by that candidate: in proportion to the root
/// of error over cost (Neyman's allocation) of cells, and changing slowly from pixel to pixel. Null
/// if they would gain too little over equal numbers of samples: those are better distributed.
[[nodiscard]] std::shared_ptr<const SampleRates> choose_rates(const PilotGrid& grid,
                                                              const CellErrors& cells,
                                                              std::size_t candidate);

}  // namespace bdpt
