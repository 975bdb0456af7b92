#pragma once

#include "pilot/pilot.h"
#include "pilot/pilot_constants.h"

#include <bdpt/part/sample_rates.h>

#include <cstddef>
#include <memory>

namespace bdpt {

/// Returns the candidate of `among` that has the smallest error at equal cost, of those whose light
/// paths fit into memory; the first one always does. Chosen connections, and more than one light
/// path, are taken only for a gain that exceeds the noise of the prediction.
[[nodiscard]] std::size_t choose(const PilotMeasurements& pilot,
                                 const PerCandidate<Candidate>& among = candidates,
                                 const ChoiceConstants& constants = pilot_constants.choice);

/// Returns rates of samples from 1/2 to 2 for a render by that candidate: in proportion to the root
/// of error over cost (Neyman's allocation) of cells, and changing slowly from pixel to pixel. Null
/// if they would gain too little over equal numbers of samples, which are better distributed, or if
/// light is so rare that the pilot does not know errors of parts of the image.
[[nodiscard]] std::shared_ptr<const SampleRates> choose_rates(const PilotMeasurements& pilot,
                                                              std::size_t candidate);

}  // namespace bdpt
