#pragma once

#include "path/connect.h"
#include "path/random_walk.h"

namespace bdpt {

// Strategies with t = 0: the light subpath crosses a finite aperture by chance; the aperture does
// not block it.

/// Records in `path` whether `step`, which ends after `free_distance` [m], crosses the lens before.
/// `segment` is the key of the walk's segment.
void look_for_lens(const SampleContext& sample, const WalkStep& step, float free_distance,
                   SegmentKey segment, Subpath& path);

/// Returns the contribution of a lens crossing by `light_path` (t = 0).
[[nodiscard]] std::optional<Contribution> hit_lens(const SampleContext& sample,
                                                   const Subpath& light_path,
                                                   const LensCrossing& crossing,
                                                   PathWeigher& weigher);

}  // namespace bdpt
