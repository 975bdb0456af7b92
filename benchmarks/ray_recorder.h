#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace bdpt {

/// What a ray asked Embree for.
enum class RayQuery : std::uint8_t { closest_hit, any_hit };

/// A ray as Embree got it.
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
    void* scene = nullptr;  ///< the RTCScene that all were traced in
    std::vector<RecordedRay> rays;
    std::uint64_t hits = 0;  ///< that they had
};

/// While one exists, every single-ray query to Embree that any library of this process makes is
/// written down. The executable's own rtcIntersect1 and rtcOccluded1, which come before Embree's
/// when libraries are linked, see to that; the library needs no hook. At most one at a time.
class RayRecorder {
public:
    RayRecorder();
    ~RayRecorder();
    RayRecorder(const RayRecorder&) = delete;
    RayRecorder& operator=(const RayRecorder&) = delete;

    /// That of the calling thread.
    [[nodiscard]] RayLog& log();
    /// One for each thread that traced rays; ends the recording. Not while rays are traced.
    [[nodiscard]] std::vector<std::unique_ptr<RayLog>> take_logs();

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<RayLog>> logs_;
    std::uint64_t number_;
};

}  // namespace bdpt
