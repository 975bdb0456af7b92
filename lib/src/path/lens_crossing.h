#pragma once

#include "path/connect.h"
#include "path/walk_step.h"

namespace bdpt {

// Strategies with t = 0: the light subpath crosses a finite aperture by chance; the aperture does
// not block it.

/// Records in `path` if `step`, which ends after `free_distance` [m], crosses the lens before.
/// `segment` is the one that the walk follows.
void look_for_lens(const SampleContext& sample, const WalkStep& step, float free_distance,
                   SegmentKey segment, Subpath& path);

/// t = 0: the contribution of a crossing of the lens by `light_path`.
[[nodiscard]] std::optional<Contribution> hit_lens(const SampleContext& sample,
                                                   const Subpath& light_path,
                                                   const LensCrossing& crossing,
                                                   PathWeigher& weigher);

}  // namespace bdpt
