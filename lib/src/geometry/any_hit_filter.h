#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// Where a ray meets a triangle that it may pass.
struct AnyHit {
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    Vec2 barycentrics{0.0f};  ///< of the second and third corner
    SegmentKey segment;       ///< the ray's
};

/// The any-hit decision: which surfaces rays pass as if they were not there. It depends on
/// materials, which this layer does not know, so the caller passes functions. Both are called from
/// many threads at once.
struct AnyHitFilter {
    const void* owner = nullptr;  ///< first argument of both functions
    /// Could any ray pass any triangle of that instance? Null: no. The others cost nothing.
    bool (*concerns)(const void* owner, std::uint32_t instance) noexcept = nullptr;
    /// Has to give the same answer each time: how often it is asked is not known.
    bool (*passes)(const void* owner, const AnyHit& crossing) noexcept = nullptr;
};

}  // namespace bdpt
