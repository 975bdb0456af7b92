// How much of a full bdpt render is rays: its rays per second against those of the very same rays
// when nothing but Embree works on them, by single-ray calls in the same scene and order. In turn.

#include "geometry/embree.h"

#include <bdpt/harness/bench/cpu_seconds.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "measure.h"
#include "ray_recorder.h"
#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    SubjectSettings subject{.size = 256};
    std::int64_t samples = 1;
    int rounds = 5;
};

using RayLogs = std::vector<std::unique_ptr<RayLog>>;

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

/// As callbacks get to know it.
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

/// Traces all rays; how many of them hit.
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

struct Totals {
    std::uint64_t rays = 0;
    std::uint64_t closest = 0;  // queries for the closest hit
    std::uint64_t hits = 0;
};

Totals totals_of(const RayLogs& logs)
{
    Totals totals;
    for (const auto& log : logs) {
        totals.rays += log->rays.size();
        totals.hits += log->hits;
        for (const RecordedRay& ray : log->rays) {
            totals.closest += ray.query == RayQuery::closest_hit ? 1U : 0U;
        }
    }
    return totals;
}

RayLogs record(const Subject& subject, const RenderOptions& options)
{
    RayRecorder recorder;
    static_cast<void>(render(subject.scene, subject.camera, options));
    return recorder.take_logs();
}

/// False when the replay does not do what the render did.
bool measure(const std::string& file, const Settings& settings)
{
    const Subject subject = load_subject(file, settings.subject);
    RenderOptions options = subject.options;
    options.samples.end = settings.samples;
    const RayLogs logs = record(subject, options);
    const Totals totals = totals_of(logs);

    bool equal = true;
    const auto seconds = in_turn(2, settings.rounds, [&](std::size_t variant, int) {
        const double begin = harness::cpu_seconds();
        if (variant == 0) {
            const RenderResult result = render(subject.scene, subject.camera, options);
            equal = equal && result.stats.rays.total() == totals.rays;
        } else {
            equal = equal && replay(logs) == totals.hits;
        }
        return harness::cpu_seconds() - begin;
    });
    const double rays = static_cast<double>(totals.rays);
    std::printf(
        "%s: %llu triangles, %.1f M rays, %.0f %% of them for closest hits, %.1f a sample\n",
        subject.name.c_str(),
        static_cast<unsigned long long>(subject.scene.counts().instanced_triangles), 1e-6 * rays,
        100.0 * static_cast<double>(totals.closest) / rays,
        rays / static_cast<double>(settings.samples * options.width * options.height));
    std::printf("  M rays a CPU second: bdpt %.2f, Embree alone %.2f; ratio %.3f\n",
                1e-6 * rays / median(seconds[0]), 1e-6 * rays / median(seconds[1]),
                median_ratio(seconds[1], seconds[0]));
    if (!equal) {
        std::fprintf(stderr, "error: the replay did not trace what the render did\n");
    }
    return equal;
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Rays per second of bdpt against those of Embree alone, for the same rays"};
    app.add_option("scenes", settings.scenes, "glTF files with a camera")->required();
    app.add_option("--spp", settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--rounds", settings.rounds, "Renders and replays")->capture_default_str();
    add_options(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        int failures = 0;
        for (const std::string& scene : settings.scenes) {
            failures += measure(scene, settings) ? 0 : 1;
        }
        return failures == 0 ? 0 : 1;
    });
}
