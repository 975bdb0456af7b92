#pragma once

#include "path/path_vertex.h"
#include "path/sample_context.h"

namespace bdpt {

/// The densities at a light vertex x_0 as seen from its neighbour x_1, whichever strategy made
/// them.
struct LightDensities {
    AreaPdf emit;     ///< x_0 as the start of a light path (s >= 2)
    AreaPdf to_next;  ///< x_1 sampled from x_0 by a light path, media left out
};

/// The receiver x_1 for which next-event estimation chooses a light. It does not depend on the walk
/// that made the vertex: on opaque surfaces, both sides of a join lie on one side.
[[nodiscard]] LightSampleContext light_sample_context(const PathVertex& x1);

/// x_0 on light `x0.light`, sampled from x_1 by next-event estimation.
[[nodiscard]] AreaPdf next_event_density(const SampleContext& sample, const PathVertex& x0,
                                         const PathVertex& x1, NextEventSampling sampling);

/// `x0` is a vertex on light `x0.light`.
[[nodiscard]] LightDensities light_densities(const SampleContext& sample, const PathVertex& x0,
                                             const SegmentEnd& x1);

/// Can the strategy s = t = 1, which joins a light point to a lens point, see this light?
[[nodiscard]] bool can_be_seen_directly(const Light& light, const Camera& camera);

}  // namespace bdpt
