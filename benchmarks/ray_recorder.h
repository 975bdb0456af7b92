#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace bdpt {

/// Kind of a query to Embree.
enum class RayQuery : std::uint8_t { closest_hit, any_hit };

/// A ray as passed to Embree.
struct RecordedRay {
    Vec3 origin{0.0f};
    float t_near = 0.0f;
    Vec3 direction{0.0f};
    float t_far = 0.0f;
    SegmentKey segment;
    std::uint32_t id = 0;
    RayQuery query = RayQuery::closest_hit;
};

/// The rays of one thread, in order.
struct RayLog {
    void* scene = nullptr;  ///< the RTCScene that all rays were traced in
    std::vector<RecordedRay> rays;
    std::uint64_t hits = 0;  ///< number of rays that hit
};

/// Records every single-ray query to Embree by any library of this process during its lifetime. The
/// executable defines its own rtcIntersect1 and rtcOccluded1, which precede Embree's when libraries
/// are linked; the library needs no hook. At most one recorder exists at a time.
class RayRecorder {
public:
    RayRecorder();
    ~RayRecorder();
    RayRecorder(const RayRecorder&) = delete;
    RayRecorder& operator=(const RayRecorder&) = delete;

    /// Returns the log of the calling thread.
    [[nodiscard]] RayLog& log();
    /// Returns one log per thread that traced rays, and ends the recording. Not called while rays
    /// are traced.
    [[nodiscard]] std::vector<std::unique_ptr<RayLog>> take_logs();

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<RayLog>> logs_;
    std::uint64_t number_;
};

}  // namespace bdpt
