#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "all_triangles.h"
#include "ray_recorder.h"
#include "subject.h"

namespace bdpt {

using RayLogs = std::vector<std::unique_ptr<RayLog>>;

struct RayTotals {
    std::uint64_t rays = 0;
    std::uint64_t closest = 0;  ///< queries for the closest hit
    std::uint64_t hits = 0;
};

/// Rays per CPU second.
struct RayThroughput {
    RayTotals totals;
    double bdpt = 0.0;    ///< by a render
    double embree = 0.0;  ///< of the same rays, when nothing but Embree works on them
    double ratio = 0.0;   ///< median over rounds of the former over the latter
    bool equal = true;    ///< renders and replays traced and hit what the recorded render did
};

/// The same when all triangles are tried.
struct LoopThroughput {
    double rays_per_second = 0.0;
    double different = 0.0;  ///< fraction of rays that Embree says otherwise of
};

/// All rays of a render.
[[nodiscard]] RayLogs record_rays(const Subject& subject, const RenderOptions& options);

/// Renders as recorded and replays of the rays take turns.
[[nodiscard]] RayThroughput measure_throughput(const Subject& subject, const RenderOptions& options,
                                               const RayLogs& logs, int rounds);

/// Some of the rays, evenly chosen: as many as a second or two suffice for.
[[nodiscard]] LoopThroughput measure_loop(const AllTriangles& triangles, const RayLogs& logs);

}  // namespace bdpt
