#pragma once

#include "geometry/embree.h"

#include <bdpt/isa.h>

#include <memory>
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

}  // namespace bdpt
