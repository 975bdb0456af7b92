#include "ray_recorder.h"

#include "geometry/embree.h"

#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <utility>

namespace bdpt {
namespace {

// Embree's functions are called without an object of ours, so the active recorder has to be global.
std::atomic<RayRecorder*> active{nullptr};

/// Returns Embree's own function of that name.
template <typename Function>
Function* original(const char* name)
{
    void* found = dlsym(RTLD_NEXT, name);
    if (found == nullptr) {
        std::abort();  // no Embree behind this library: there is nothing to trace rays with
    }
    return reinterpret_cast<Function*>(found);
}

RecordedRay recorded(const RTCRay& ray, SegmentKey segment, RayQuery query)
{
    return {.origin = {ray.org_x, ray.org_y, ray.org_z},
            .t_near = ray.tnear,
            .direction = {ray.dir_x, ray.dir_y, ray.dir_z},
            .t_far = ray.tfar,
            .segment = segment,
            .id = ray.id,
            .query = query};
}

/// Calls `trace`, and adds the ray and whether it hit to the log, if there is one.
template <typename Trace, typename IsHit>
void trace_and_record(RTCScene scene, const RTCRay& ray, SegmentKey segment, RayQuery query,
                      const Trace& trace, const IsHit& is_hit)
{
    RayRecorder* recorder = active.load(std::memory_order_relaxed);
    if (recorder == nullptr) [[likely]] {
        trace();
        return;
    }
    RayLog& log = recorder->log();
    log.scene = scene;
    log.rays.push_back(recorded(ray, segment, query));
    trace();
    log.hits += is_hit() ? 1U : 0U;
}

}  // namespace

RayRecorder::RayRecorder()
{
    static std::atomic<std::uint64_t> count{0};
    number_ = ++count;
    active = this;
}

RayRecorder::~RayRecorder()
{
    active = nullptr;
}

RayLog& RayRecorder::log()
{
    struct Own {
        std::uint64_t recorder = 0;
        RayLog* log = nullptr;
    };
    thread_local Own own;
    if (own.recorder != number_) {
        const std::lock_guard lock(mutex_);
        logs_.push_back(std::make_unique<RayLog>());
        own = {.recorder = number_, .log = logs_.back().get()};
    }
    return *own.log;
}

std::vector<std::unique_ptr<RayLog>> RayRecorder::take_logs()
{
    active = nullptr;
    return std::exchange(logs_, {});
}

}  // namespace bdpt

// Embree's functions, as found by libraries.
extern "C" {

#if BDPT_EMBREE_MAJOR >= 4
using IntersectFunction = void(RTCScene, RTCRayHit*, RTCIntersectArguments*);
using OccludedFunction = void(RTCScene, RTCRay*, RTCOccludedArguments*);

[[gnu::visibility("default")]] void rtcIntersect1(RTCScene scene, RTCRayHit* query,
                                                  RTCIntersectArguments* arguments)
{
    static IntersectFunction* const intersect = bdpt::original<IntersectFunction>("rtcIntersect1");
    bdpt::trace_and_record(
        scene, query->ray, bdpt::embree::ray_of(arguments->context).segment,
        bdpt::RayQuery::closest_hit, [=] { intersect(scene, query, arguments); },
        [=] { return query->hit.geomID != RTC_INVALID_GEOMETRY_ID; });
}

[[gnu::visibility("default")]] void rtcOccluded1(RTCScene scene, RTCRay* ray,
                                                 RTCOccludedArguments* arguments)
{
    static OccludedFunction* const occluded = bdpt::original<OccludedFunction>("rtcOccluded1");
    bdpt::trace_and_record(
        scene, *ray, bdpt::embree::ray_of(arguments->context).segment, bdpt::RayQuery::any_hit,
        [=] { occluded(scene, ray, arguments); }, [=] { return ray->tfar < 0.0f; });
}
#else
using IntersectFunction = void(RTCScene, RTCIntersectContext*, RTCRayHit*);
using OccludedFunction = void(RTCScene, RTCIntersectContext*, RTCRay*);

[[gnu::visibility("default")]] void rtcIntersect1(RTCScene scene, RTCIntersectContext* context,
                                                  RTCRayHit* query)
{
    static IntersectFunction* const intersect = bdpt::original<IntersectFunction>("rtcIntersect1");
    bdpt::trace_and_record(
        scene, query->ray, bdpt::embree::ray_of(context).segment, bdpt::RayQuery::closest_hit,
        [=] { intersect(scene, context, query); },
        [=] { return query->hit.geomID != RTC_INVALID_GEOMETRY_ID; });
}

[[gnu::visibility("default")]] void rtcOccluded1(RTCScene scene, RTCIntersectContext* context,
                                                 RTCRay* ray)
{
    static OccludedFunction* const occluded = bdpt::original<OccludedFunction>("rtcOccluded1");
    bdpt::trace_and_record(
        scene, *ray, bdpt::embree::ray_of(context).segment, bdpt::RayQuery::any_hit,
        [=] { occluded(scene, context, ray); }, [=] { return ray->tfar < 0.0f; });
}
#endif

}  // extern "C"
