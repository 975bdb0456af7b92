#pragma once

// The one place that knows which Embree is there: 3.13 and 4.x differ in include path and in how a
// query is passed.
#if BDPT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "math/segment_key.h"

namespace bdpt::embree {

#if BDPT_EMBREE_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// What callbacks get to know of a query: Embree hands them the address of its own part.
struct KeyedContext {
    Context embree;
    SegmentKey segment;
};

inline void intersect(RTCScene scene, RTCRayHit& ray_hit, SegmentKey segment)
{
    KeyedContext context{.embree = {}, .segment = segment};
#if BDPT_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context.embree);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context.embree;
    rtcIntersect1(scene, &ray_hit, &arguments);
#else
    rtcInitIntersectContext(&context.embree);
    rtcIntersect1(scene, &context.embree, &ray_hit);
#endif
}

/// Sets `ray.tfar` to minus infinity when anything is in the way.
inline void occluded(RTCScene scene, RTCRay& ray, SegmentKey segment)
{
    KeyedContext context{.embree = {}, .segment = segment};
#if BDPT_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context.embree);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context.embree;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context.embree);
    rtcOccluded1(scene, &context.embree, &ray);
#endif
}

/// The key that the query in a callback came with.
inline SegmentKey segment_of(const Context* context)
{
    return reinterpret_cast<const KeyedContext*>(context)->segment;
}

}  // namespace bdpt::embree
