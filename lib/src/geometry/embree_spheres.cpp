#include "geometry/embree_spheres.h"

#include <glm/common.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace bdpt {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

const Sphere& find_sphere(const void* spheres, unsigned index)
{
    return static_cast<const Sphere*>(spheres)[index];
}

void set_bounds(const RTCBoundsFunctionArguments* args)
{
    const Sphere& sphere = find_sphere(args->geometryUserPtr, args->primID);
    Vec3 low = sphere.center - sphere.radius;
    Vec3 high = sphere.center + sphere.radius;
    for (const Vec3& center : sphere.motion) {
        low = min(low, center - sphere.radius);
        high = max(high, center + sphere.radius);
    }
    args->bounds_o->lower_x = std::nextafter(low.x, -infinity);
    args->bounds_o->lower_y = std::nextafter(low.y, -infinity);
    args->bounds_o->lower_z = std::nextafter(low.z, -infinity);
    args->bounds_o->upper_x = std::nextafter(high.x, infinity);
    args->bounds_o->upper_y = std::nextafter(high.y, infinity);
    args->bounds_o->upper_z = std::nextafter(high.z, infinity);
}

std::optional<SphereHit> compute_hit(const RTCRay& ray, const void* spheres, unsigned index)
{
    if (ray.id == index) {
        return std::nullopt;
    }
    const Sphere& sphere = find_sphere(spheres, index);
    return intersect(sphere.motion.empty() ? sphere : sphere.at(ray.time),
                     {.origin = {ray.org_x, ray.org_y, ray.org_z},
                      .direction = {ray.dir_x, ray.dir_y, ray.dir_z},
                      .t_max = ray.tfar},
                     ray.tnear);
}

// All queries are single rays, and packets of one have the layout of the struct.

void find_hit(const RTCIntersectFunctionNArguments* args)
{
    auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
    const auto found = compute_hit(query.ray, args->geometryUserPtr, args->primID);
    if (args->valid[0] == 0 || !found) {
        return;
    }
    query.ray.tfar = found->t;
    query.hit.Ng_x = found->normal.x;
    query.hit.Ng_y = found->normal.y;
    query.hit.Ng_z = found->normal.z;
    query.hit.primID = args->primID;
    query.hit.geomID = args->geomID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;  // a farther hit may have set it
}

void find_occlusion(const RTCOccludedFunctionNArguments* args)
{
    auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
    if (args->valid[0] != 0 && compute_hit(ray, args->geometryUserPtr, args->primID)) {
        ray.tfar = -infinity;
    }
}

}  // namespace

RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres.size()));
    // Embree requires a pointer to non-const, but the callbacks do not write.
    rtcSetGeometryUserData(geometry, const_cast<Sphere*>(spheres.data()));
    rtcSetGeometryBoundsFunction(geometry, &set_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &find_hit);
    rtcSetGeometryOccludedFunction(geometry, &find_occlusion);
    return geometry;
}

}  // namespace bdpt
