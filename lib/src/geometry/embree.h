#pragma once

// The only file that depends on the Embree version: 3.13 and 4.x differ in include path and in the
// arguments of queries.
#if BDPT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "geometry/ray.h"
#include "geometry/ray_passage.h"

namespace bdpt::embree {

#if BDPT_EMBREE_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// Context of a query for callbacks: Embree passes them the address of its own part.
struct RayContext {
    Context embree;
    const Ray* ray;
    const void* owner;
    RayPassage* passage;  ///< null: `PassageRule::chance`
};

/// Traces `ray_hit`; callbacks receive `of`, the world-space ray, `owner`, the caller, and
/// `passage`.
inline void intersect(RTCScene scene, RTCRayHit& ray_hit, const Ray& of, const void* owner,
                      RayPassage* passage)
{
    RayContext context{.embree = {}, .ray = &of, .owner = owner, .passage = passage};
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

/// Sets `ray.tfar` to minus infinity if anything blocks the ray.
inline void occluded(RTCScene scene, RTCRay& ray, const Ray& of, const void* owner,
                     RayPassage* passage)
{
    RayContext context{.embree = {}, .ray = &of, .owner = owner, .passage = passage};
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

/// Returns the query that a callback belongs to, with its world-space ray.
inline const RayContext& to_query(const Context* context)
{
    return *reinterpret_cast<const RayContext*>(context);
}

}  // namespace bdpt::embree
