#include "geometry/embree.h"

#include <bdpt/error.h>

#include <glm/common.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace bdpt {
namespace {

#if defined(__x86_64__) || defined(__i386__)
constexpr bool is_x86 = true;
#else
constexpr bool is_x86 = false;
#endif

[[noreturn]] void throw_embree_error(RTCError code, const char* action)
{
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
        throw Error(ErrorCode::out_of_memory, std::string("not enough memory to ") + action);
    }
    throw Error(ErrorCode::internal, std::string("Embree failed to ") + action + " (error " +
                                         std::to_string(static_cast<int>(code)) + ")");
}

/// Starts a device; null if the CPU lacks `isa`.
RTCDevice start(Isa isa)
{
    // By default Embree chooses the width of its BVH by the model of the CPU.
    const std::string config =
        isa == Isa::native ? std::string()
                           : std::string("isa=") + isa_name(isa) + ",frequency_level=simd256";
    RTCDevice device = rtcNewDevice(config.c_str());
    if (device == nullptr) {
        const RTCError code = rtcGetDeviceError(nullptr);
        if (code != RTC_ERROR_UNSUPPORTED_CPU) {
            throw_embree_error(code, "start");
        }
    }
    return device;
}

struct Started {
    RTCDevice device = nullptr;
    Isa isa = Isa::native;
};

Started start_best()
{
    if constexpr (is_x86) {
        for (auto isa = all_isas.rbegin(); isa != all_isas.rend(); ++isa) {
            if (RTCDevice device = start(*isa)) {
                return {device, *isa};
            }
        }
        return {};
    }
    return {start(Isa::native), Isa::native};
}

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

EmbreeDevice::EmbreeDevice(Isa isa) : isa_(isa)
{
    if (isa == Isa::native) {
        const Started best = start_best();
        device_.reset(best.device);
        isa_ = best.isa;
        if (!device_) {
            throw Error(ErrorCode::internal,
                        "this CPU lacks the instruction set that Embree was "
                        "built for");
        }
        return;
    }
    if (is_x86) {
        device_.reset(start(isa));
    }
    if (!device_) {
        throw Error(ErrorCode::usage,
                    std::string("isa ") + isa_name(isa) + ": this CPU lacks that instruction set");
    }
}

std::string EmbreeDevice::version() const
{
    const auto number = [this](RTCDeviceProperty property) {
        return std::to_string(rtcGetDeviceProperty(get(), property));
    };
    return number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." +
           number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
           number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

void check_embree(RTCDevice device, const char* action)
{
    const RTCError code = rtcGetDeviceError(device);
    if (code != RTC_ERROR_NONE) {
        throw_embree_error(code, action);
    }
}

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
