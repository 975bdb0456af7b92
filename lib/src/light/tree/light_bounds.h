#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// All directions within an angle of an axis.
struct DirectionCone {
    Vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit length
    float cos_angle = -1.0f;      ///< -1: all directions

    [[nodiscard]] bool is_whole() const { return cos_angle <= -1.0f; }
};

/// Returns a cone around both, the narrowest up to rounding [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", sec. 4.1].
[[nodiscard]] DirectionCone merged(const DirectionCone& a, const DirectionCone& b);

enum class EmittingSides : std::uint8_t { front, both };

/// Position and direction bounds of one or several lights [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", sec. 4.1]. Light leaves a
/// point of the box at an angle of at most `falloff` from a direction of the cone of normals.
struct LightBounds {
    Vec3 min{0.0f};  ///< bounding box [m]
    Vec3 max{0.0f};
    DirectionCone normals;     ///< cone of normals, or of axes of lights without surface
    float cos_falloff = 0.0f;  ///< cosine of the falloff angle; 0: a hemisphere, as surfaces emit
    EmittingSides sides = EmittingSides::front;  ///< `both`: also in opposite directions
    double intensity = 0.0;                      ///< sum of the maximum luminous intensities [cd]

    [[nodiscard]] Vec3 center() const { return 0.5f * min + 0.5f * max; }
    /// Extends the box to contain `p`.
    void contain(Vec3 p);
};

[[nodiscard]] LightBounds merged(const LightBounds& a, const LightBounds& b);

/// Returns the solid angle into which the lights emit [sr]: the measure M_Omega of sec. 4.4.
[[nodiscard]] float orientation_measure(const LightBounds& bounds);

}  // namespace bdpt
