#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace bdpt {

/// Returns the length of a vector, correct even if its square exceeds the range of floats: area
/// normals of triangles with edges of more than 4e9 m, or less than 1e-9 m, are that long or short.
[[nodiscard]] inline float compute_length(Vec3 v)
{
    const float squared = dot(v, v);
    if (squared >= std::numeric_limits<float>::min() &&
        squared <= std::numeric_limits<float>::max()) [[likely]] {
        return std::sqrt(squared);
    }
    const glm::dvec3 wide(v);
    return static_cast<float>(std::sqrt(dot(wide, wide)));
}

}  // namespace bdpt
