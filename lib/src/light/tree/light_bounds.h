#pragma once

#include "light/tree/direction_cone.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

enum class EmittingSides : std::uint8_t { front, both };

/// Where a light is, or several lights are, and where they shine [Conty Estevez and Kulla 2018,
/// "Importance Sampling of Many Lights with Adaptive Tree Splitting", sec. 4.1]. Light leaves a
/// point of the box at an angle of at most `falloff` from a direction of the cone of normals.
struct LightBounds {
    Vec3 min{0.0f};  ///< of the box around it [m]
    Vec3 max{0.0f};
    DirectionCone normals;     ///< or axes, of what has no surface
    float cos_falloff = 0.0f;  ///< cosine of that angle; 0: half a turn, as a surface shines
    EmittingSides sides = EmittingSides::front;  ///< both: the other way round as well
    double intensity = 0.0;                      ///< luminance of the greatest, added up [cd]

    [[nodiscard]] Vec3 center() const { return 0.5f * min + 0.5f * max; }
    /// Makes the box larger.
    void contain(Vec3 p);
};

[[nodiscard]] LightBounds merged(const LightBounds& a, const LightBounds& b);

/// How far the lights shine [sr]: the measure M_Omega of sec. 4.4.
[[nodiscard]] float orientation_measure(const LightBounds& bounds);

}  // namespace bdpt
