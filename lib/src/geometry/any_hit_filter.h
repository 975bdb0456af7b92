#pragma once

#include "math/random_numbers.h"

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

/// Surfaces that rays may pass. They depend on materials, which this layer does not know, so the
/// caller passes functions. All are called from many threads at once, and must be deterministic:
/// the number of calls is unknown. `RayPassage` decides what a ray does there.
struct AnyHitFilter {
    const void* owner = nullptr;  ///< first argument of all functions
    /// Tests whether any ray could pass any triangle of that instance; null: no. Other instances
    /// cost nothing.
    bool (*concerns)(const void* owner, std::uint32_t instance) noexcept = nullptr;
    /// Returns the fraction of rays that hit the surface there, in [0, 1].
    float (*opacity)(const void* owner, const AnyHit& surface) noexcept = nullptr;
    /// Returns the factor of light that passes there, in [0, 1].
    Rgb (*tint)(const void* owner, const AnyHit& surface) noexcept = nullptr;
};

}  // namespace bdpt
