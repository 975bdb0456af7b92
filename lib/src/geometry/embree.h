#pragma once

// The one place that knows which Embree is there: 3.13 and 4.x differ in include path and in how a
// query is passed.
#if BDPT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "geometry/ray.h"

namespace bdpt::embree {

#if BDPT_EMBREE_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// What callbacks get to know of a query: Embree hands them the address of its own part.
struct RayContext {
    Context embree;
    const Ray* ray;
    const void* owner;
};

/// `of`: the ray of `ray_hit`, as callbacks will get to know it, and `owner`: who asks.
inline void intersect(RTCScene scene, RTCRayHit& ray_hit, const Ray& of, const void* owner)
{
    RayContext context{.embree = {}, .ray = &of, .owner = owner};
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
inline void occluded(RTCScene scene, RTCRay& ray, const Ray& of, const void* owner)
{
    RayContext context{.embree = {}, .ray = &of, .owner = owner};
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

/// The query that a callback belongs to; its ray is that in the world.
inline const RayContext& query_of(const Context* context)
{
    return *reinterpret_cast<const RayContext*>(context);
}

}  // namespace bdpt::embree
