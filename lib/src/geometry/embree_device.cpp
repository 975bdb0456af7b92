#include "geometry/embree_device.h"

#include <bdpt/error.h>

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

}  // namespace bdpt
