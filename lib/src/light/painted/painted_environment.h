#pragma once

#include <bdpt/light_desc.h>
#include <glm/vec3.hpp>

#include <functional>

namespace bdpt {

/// Number of columns and rows of an environment that code makes.
struct PaintedSize {
    /// The sine and the cosine of half the height of a row, pi / (2 rows): turning by it takes no
    /// sine of the C library, which may differ between machines.
    double half_step_sine;
    double half_step_cosine;
    int rows;  ///< there are twice as many columns
};

inline constexpr PaintedSize painted_32_rows{0.049067674327418015, 0.99879545620517239, 32};
inline constexpr PaintedSize painted_128_rows{0.012271538285719925, 0.99992470183914450, 128};

/// A grey environment of the radiance that `radiance` gives for directions of unit length, scaled
/// to a mean of 1 nit. The same bits on all machines if `radiance` is.
[[nodiscard]] EnvironmentLightDesc painted_environment(
    const PaintedSize& size, const std::function<double(const glm::dvec3&)>& radiance);

/// 0 for x <= 0 and 1 for x >= 1, and smooth between them.
[[nodiscard]] double smooth_step(double x);

}  // namespace bdpt
