#include "geometry/embree.h"

#include <bdpt/error.h>

#include "catch.hpp"

#include <optional>
#include <string>

namespace bdpt::embree_device_test {
namespace {

#if defined(__x86_64__)

bool cpu_has(Isa isa)
{
    switch (isa) {
        case Isa::avx512:
            return __builtin_cpu_supports("avx512bw") != 0;
        case Isa::avx2:
            return __builtin_cpu_supports("avx2") != 0;
        case Isa::avx:
            return __builtin_cpu_supports("avx") != 0;
        case Isa::sse4_2:
            return __builtin_cpu_supports("sse4.2") != 0;
        case Isa::sse2:
        case Isa::native:
            break;
    }
    return true;
}

TEST_CASE("a device traces with the instruction set that it was asked for, or says why not",
          "[geometry]")
{
    for (const Isa isa : all_isas) {
        CAPTURE(isa_name(isa));
        std::optional<EmbreeDevice> device;
        std::string message;
        try {
            device.emplace(isa);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            message = error.what();
        }
        REQUIRE(device.has_value() == cpu_has(isa));
        if (!device) {
            CHECK(message.find(isa_name(isa)) != std::string::npos);
            continue;
        }
        if (isa == Isa::native) {
            continue;
        }
        CHECK(device->isa() == isa);
        // Embree tells the width of its vectors only.
        const auto has = [&](RTCDeviceProperty property) {
            return rtcGetDeviceProperty(device->get(), property) != 0;
        };
        CHECK(has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) == (isa >= Isa::avx));
        CHECK(has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) == (isa == Isa::avx512));
    }
}

TEST_CASE("a device that may choose takes the best instruction set", "[geometry]")
{
    const EmbreeDevice device(Isa::native);
    CHECK(device.isa() != Isa::native);
    for (const Isa isa : all_isas) {
        if (cpu_has(isa)) {
            CHECK(device.isa() >= isa);
        }
    }
}

#endif

TEST_CASE("instruction sets have the names that Embree knows", "[geometry]")
{
    CHECK(std::string(isa_name(Isa::native)) == "native");
    CHECK(std::string(isa_name(Isa::sse2)) == "sse2");
    CHECK(std::string(isa_name(Isa::sse4_2)) == "sse4.2");
    CHECK(std::string(isa_name(Isa::avx)) == "avx");
    CHECK(std::string(isa_name(Isa::avx2)) == "avx2");
    CHECK(std::string(isa_name(Isa::avx512)) == "avx512");
}

}  // namespace
}  // namespace bdpt::embree_device_test
