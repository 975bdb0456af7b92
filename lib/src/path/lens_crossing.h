#pragma once

#include "path/connect.h"
#include "path/walk_step.h"

namespace bdpt {

// The strategies with t = 0: a light walk crosses a finite lens, which stops nobody, by chance.

/// Records in `path` if `step`, which ends after `free_distance` [m], crosses the lens before.
/// `segment` is the one that the walk follows.
void look_for_lens(const SampleContext& sample, const WalkStep& step, float free_distance,
                   SegmentKey segment, Subpath& path);

/// t = 0: what a crossing of `light_path` brings.
[[nodiscard]] std::optional<Contribution> hit_lens(const SampleContext& sample,
                                                   const Subpath& light_path,
                                                   const LensCrossing& crossing,
                                                   PathWeigher& weigher);

}  // namespace bdpt
