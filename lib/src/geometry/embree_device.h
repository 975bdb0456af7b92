#pragma once

#include "geometry/embree.h"

#include <bdpt/isa.h>

#include <memory>
#include <string>
#include <type_traits>

namespace bdpt {

/// Embree, started with one instruction set.
class EmbreeDevice {
public:
    /// `isa` native: the best one that this CPU and Embree agree on. Throws `Error`: usage when the
    /// CPU lacks `isa`; out_of_memory or internal when Embree fails.
    explicit EmbreeDevice(Isa isa);

    [[nodiscard]] RTCDevice get() const { return device_.get(); }
    /// The one in use; native only where it is not known, on other CPUs than x86.
    [[nodiscard]] Isa isa() const { return isa_; }
    /// Of the library that is loaded: "3.13.5".
    [[nodiscard]] std::string version() const;

private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    };

    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    Isa isa_;
};

/// Throws `Error` (out_of_memory or internal) when a call since the last check has failed on this
/// thread. `device` is null for the start of a device itself; `action` completes "failed to".
void check_embree(RTCDevice device, const char* action);

}  // namespace bdpt
