#pragma once

#include "math/random_numbers.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

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

/// A surface on a ray that the ray may pass. Without default values: many are never used.
struct Crossing {
    float t;  ///< along the ray
    std::uint32_t instance;
    std::uint32_t triangle;
    float opacity;  ///< fraction of rays that hit it, in (0, 1)
    Rgb factor;     ///< of light that passes, by the rule
};

/// What a ray does at surfaces that it may pass.
enum class PassageRule : std::uint8_t {
    chance,       ///< hits or passes them by the segment's number of the surface
    expectation,  ///< passes those of opacity < 1, with the factor that they let pass on average
    tint,         ///< passes all, with their tint
    record,       ///< passes those of opacity < 1, and records them
};

/// The passage of one ray through surfaces that it may pass: what it does there, and what it finds.
/// What it finds up to the hit does not depend on the order in which Embree reports surfaces.
class RayPassage {
public:
    explicit RayPassage(PassageRule rule) : rule_(rule) {}

    /// Tests whether the ray passes a surface at `t` along it; its filter is `filter`.
    [[nodiscard]] bool passes(const AnyHitFilter& filter, const AnyHit& surface, float t) noexcept;
    /// Leaves out the factor of a surface, which is the end of the ray.
    void leave_out(std::uint32_t instance, std::uint32_t triangle) noexcept
    {
        add({.t = 0.0f,
             .instance = instance,
             .triangle = triangle,
             .opacity = 1.0f,
             .factor = Rgb(1.0f)});
    }
    /// Looks for tints while passing by chance.
    void look_for_tints() noexcept { looks_for_tints_ = true; }
    /// Tests whether the ray passed a surface with a tint: before its hit or beyond.
    [[nodiscard]] bool is_tinted() const noexcept { return is_tinted_; }
    /// Returns the factor of light by expectation, or by tint.
    [[nodiscard]] Rgb factor() noexcept;
    /// Sets the distance of the hit; infinite at first.
    void set_end(float t) noexcept { end_ = t; }
    /// Tests whether `crossings` are all that there are before the hit.
    [[nodiscard]] bool has_all() const noexcept { return !(nearest_dropped_ < end_); }
    /// Returns the recorded surfaces before the hit, nearest first: at most `room`.
    [[nodiscard]] std::span<const Crossing> crossings() noexcept;

    static constexpr std::size_t room = 32;

private:
    /// Keeps the nearest surfaces, each once: Embree may report a hit more than once.
    void add(const Crossing& crossing) noexcept;
    void drop(const Crossing& crossing) noexcept;
    void sort() noexcept;

    PassageRule rule_;
    bool looks_for_tints_ = false;
    bool is_tinted_ = false;
    float end_ = std::numeric_limits<float>::infinity();
    float nearest_dropped_ = std::numeric_limits<float>::infinity();
    std::array<std::int64_t, 3> dropped_logs_{};  // sums of logarithms of factors, times `log_one`
    std::size_t count_ = 0;
    std::array<Crossing, room> crossings_;
};

}  // namespace bdpt
