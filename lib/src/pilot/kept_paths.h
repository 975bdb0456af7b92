#pragma once

#include "pilot/pilot_splats.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Maximum number of paths that are all kept.
inline constexpr std::size_t kept_paths = 8;

/// If `paths` has more than `kept_paths` from `first` on, keeps about as many of these, whose
/// `number` grows so that sums over all paths remain unbiased. The chance of each grows with its
/// light and with its error, so the brightest are kept. `random` selects the random number.
void keep_some(std::vector<PilotContribution>& paths, std::size_t first, std::uint64_t random);

}  // namespace bdpt
