#pragma once

// The one place that knows which Embree is there: 3.13 and 4.x differ in include path and in how a
// query is passed.
#if BDPT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace bdpt::embree {

inline void intersect(RTCScene scene, RTCRayHit& ray_hit)
{
#if BDPT_EMBREE_MAJOR >= 4
    rtcIntersect1(scene, &ray_hit, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray_hit);
#endif
}

/// Sets `ray.tfar` to minus infinity when anything is in the way.
inline void occluded(RTCScene scene, RTCRay& ray)
{
#if BDPT_EMBREE_MAJOR >= 4
    rtcOccluded1(scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace bdpt::embree
