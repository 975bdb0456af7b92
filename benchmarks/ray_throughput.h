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
    std::uint64_t closest = 0;  ///< closest-hit queries
    std::uint64_t hits = 0;
};

/// Rays per CPU second.
struct RayThroughput {
    RayTotals totals;
    double bdpt = 0.0;    ///< in a render
    double embree = 0.0;  ///< for the same rays traced by Embree alone
    double ratio = 0.0;   ///< median over rounds of bdpt / embree
    bool equal = true;    ///< renders and replays have the rays and hits of the recorded render
};

/// Rays per second if all triangles are tested.
struct LoopThroughput {
    double rays_per_second = 0.0;
    double different = 0.0;  ///< fraction of rays whose result differs from Embree's
};

/// Records all rays of a render.
[[nodiscard]] RayLogs record_rays(const Subject& subject, const RenderOptions& options);

/// Measures the render, as recorded, and replays of its rays, interleaved.
[[nodiscard]] RayThroughput measure_throughput(const Subject& subject, const RenderOptions& options,
                                               const RayLogs& logs, int rounds);

/// Measures a subset of the rays, evenly spaced: as many as take a second or two.
[[nodiscard]] LoopThroughput measure_loop(const AllTriangles& triangles, const RayLogs& logs);

}  // namespace bdpt
