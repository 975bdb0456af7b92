#include "ray_throughput.h"

#include "geometry/embree.h"

#include <bdpt/eval/bench/cpu_seconds.h>

#include <algorithm>

#include "measure.h"

namespace bdpt {
namespace {

RTCRay to_embree(const RecordedRay& ray)
{
    RTCRay out{};
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.tnear = ray.t_near;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.tfar = ray.t_far;
    out.mask = 0xffffffffU;
    out.id = ray.id;
    return out;
}

/// Converts a ray to the form that callbacks receive.
Ray as_ray(const RecordedRay& ray)
{
    return {.origin = ray.origin,
            .direction = ray.direction,
            .t_max = ray.t_far,
            .ignored_sphere = ray.id,
            .segment = ray.segment};
}

bool hits(RTCScene scene, const RecordedRay& ray)
{
    if (ray.query == RayQuery::any_hit) {
        RTCRay query = to_embree(ray);
        embree::occluded(scene, query, as_ray(ray));
        return query.tfar < 0.0f;
    }
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(scene, query, as_ray(ray));
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

/// Traces all rays; returns the number of hits.
std::uint64_t replay(const RayLogs& logs)
{
    std::uint64_t count = 0;
    for (const auto& log : logs) {
        for (const RecordedRay& ray : log->rays) {
            count += hits(static_cast<RTCScene>(log->scene), ray) ? 1U : 0U;
        }
    }
    return count;
}

RayTotals compute_totals(const RayLogs& logs)
{
    RayTotals totals;
    for (const auto& log : logs) {
        totals.rays += log->rays.size();
        totals.hits += log->hits;
        for (const RecordedRay& ray : log->rays) {
            totals.closest += ray.query == RayQuery::closest_hit ? 1U : 0U;
        }
    }
    return totals;
}

}  // namespace

RayLogs record_rays(const Subject& subject, const RenderOptions& options)
{
    RayRecorder recorder;
    static_cast<void>(render(subject.scene, subject.camera, options));
    return recorder.take_logs();
}

RayThroughput measure_throughput(const Subject& subject, const RenderOptions& options,
                                 const RayLogs& logs, int rounds)
{
    RayThroughput result{.totals = compute_totals(logs)};
    const auto seconds = in_turn(2, rounds, [&](std::size_t variant, int) {
        const double begin = eval::cpu_seconds();
        if (variant == 0) {
            const RenderStats stats = render(subject.scene, subject.camera, options).stats;
            result.equal = result.equal && stats.rays.total() == result.totals.rays;
        } else {
            result.equal = result.equal && replay(logs) == result.totals.hits;
        }
        return eval::cpu_seconds() - begin;
    });
    const auto rays = static_cast<double>(result.totals.rays);
    result.bdpt = rays / median(seconds[0]);
    result.embree = rays / median(seconds[1]);
    result.ratio = median_ratio(seconds[1], seconds[0]);
    return result;
}

LoopThroughput measure_loop(const AllTriangles& triangles, const RayLogs& logs)
{
    constexpr std::uint64_t max_tests = 400'000'000;  // a second or two
    const std::uint64_t max_rays = std::max<std::uint64_t>(max_tests / triangles.size(), 64);
    const std::uint64_t step = compute_totals(logs).rays / max_rays + 1;
    std::vector<const RecordedRay*> rays;
    std::vector<bool> expected;
    std::uint64_t number = 0;
    for (const auto& log : logs) {
        for (const RecordedRay& ray : log->rays) {
            if (number++ % step == 0) {
                rays.push_back(&ray);
                expected.push_back(hits(static_cast<RTCScene>(log->scene), ray));
            }
        }
    }
    std::vector<bool> found;
    const double begin = eval::cpu_seconds();
    for (const RecordedRay* ray : rays) {
        found.push_back(triangles.is_hit_by(*ray));
    }
    const double seconds = eval::cpu_seconds() - begin;
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        different += found[i] != expected[i] ? 1U : 0U;
    }
    const auto count = static_cast<double>(rays.size());
    return {.rays_per_second = count / seconds,
            .different = static_cast<double>(different) / count};
}

}  // namespace bdpt
