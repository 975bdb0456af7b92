#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
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

/// The tint of the surfaces that a ray passes: the product of their factors, in any order.
class PassedTint {
public:
    /// Multiplies by the factor of a triangle, once: Embree may report a hit more than once.
    void pass(const AnyHit& crossing, Rgb factor) noexcept
    {
        const std::uint64_t triangle = std::uint64_t{crossing.instance} << 32U | crossing.triangle;
        for (std::size_t i = 0; i < known_count_; ++i) {
            if (known_[i] == triangle) {
                return;
            }
        }
        if (known_count_ < known_.size()) {
            known_[known_count_++] = triangle;
        }
        factor_ *= factor;
    }
    [[nodiscard]] Rgb factor() const noexcept { return factor_; }

private:
    Rgb factor_{1.0f};
    std::size_t known_count_ = 0;
    std::array<std::uint64_t, 32> known_;  // others are not expected to be reported twice
};

/// The any-hit decision: which surfaces rays pass through. It depends on materials, which this
/// layer does not know, so the caller passes functions. All are called from many threads at once.
struct AnyHitFilter {
    const void* owner = nullptr;  ///< first argument of all functions
    /// Tests whether any ray could pass any triangle of that instance; null: no. Other instances
    /// cost nothing.
    bool (*concerns)(const void* owner, std::uint32_t instance) noexcept = nullptr;
    /// Tests whether the ray passes. Must be deterministic: the number of calls is unknown.
    bool (*passes)(const void* owner, const AnyHit& crossing) noexcept = nullptr;
    /// Returns the factor of light that passes there, in [0, 1]; as deterministic.
    Rgb (*tint)(const void* owner, const AnyHit& crossing) noexcept = nullptr;
};

}  // namespace bdpt
