#pragma once

#include <bdpt/types.h>

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

}  // namespace bdpt
