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
#include "geometry/sphere.h"

#include <bdpt/isa.h>

#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace bdpt {

/// An Embree device with a chosen instruction set.
class EmbreeDevice {
public:
    /// `isa` native selects the best one that this CPU and Embree support. Throws `Error`: usage if
    /// the CPU lacks `isa`; out_of_memory or internal if Embree fails.
    explicit EmbreeDevice(Isa isa);

    [[nodiscard]] RTCDevice get() const { return device_.get(); }
    /// Returns the instruction set in use; native only if it is unknown, on CPUs other than x86.
    [[nodiscard]] Isa isa() const { return isa_; }
    /// Returns the version of the loaded library: "3.13.5".
    [[nodiscard]] std::string version() const;

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    };

    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    Isa isa_;
};

/// Throws `Error` (out_of_memory or internal) if a call since the last check has failed on this
/// thread. `device` is null for the creation of a device itself; `action` completes "failed to".
void check_embree(RTCDevice device, const char* action);

/// Creates a geometry of spheres; the caller releases it, and `spheres` must outlive it. Embree's
/// own spheres compute in float, which frays the outline of distant small ones, so these are a user
/// geometry. A ray's `id` names the sphere that it ignores.
[[nodiscard]] RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres);

}  // namespace bdpt

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
