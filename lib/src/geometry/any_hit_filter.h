#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// A hit of a triangle that the ray may pass.
struct AnyHit {
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    Vec2 barycentrics{0.0f};  ///< weights of the second and third vertex
    Vec3 ng{0.0f};            ///< as in `TriangleHit`
    Vec3 direction{0.0f};     ///< of the ray, not unit
    SegmentKey segment;       ///< key of the ray's segment
};

/// The any-hit decision: which surfaces rays pass through. It depends on materials, which this
/// layer does not know, so the caller passes functions. Both are called from many threads at once.
struct AnyHitFilter {
    const void* owner = nullptr;  ///< first argument of both functions
    /// Tests whether any ray could pass any triangle of that instance; null: no. Other instances
    /// cost nothing.
    bool (*concerns)(const void* owner, std::uint32_t instance) noexcept = nullptr;
    /// Tests whether the ray passes. Must be deterministic: the number of calls is unknown.
    bool (*passes)(const void* owner, const AnyHit& crossing) noexcept = nullptr;
};

}  // namespace bdpt
