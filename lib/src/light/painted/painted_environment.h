#pragma once

#include <bdpt/light_desc.h>
#include <glm/vec3.hpp>

#include <functional>

namespace bdpt {

/// Size of a procedural environment.
struct PaintedSize {
    /// Sine and cosine of half the height of a row, pi / (2 rows): rotating by it needs no sine of
    /// the C library, which may differ between machines.
    double half_step_sine;
    double half_step_cosine;
    int rows;  ///< number of rows; there are twice as many columns
};

inline constexpr PaintedSize painted_32_rows{0.049067674327418015, 0.99879545620517239, 32};
inline constexpr PaintedSize painted_128_rows{0.012271538285719925, 0.99992470183914450, 128};

/// Returns a grey environment with the radiance that `radiance` gives for unit directions, scaled
/// to a mean of 1 nit. Bit-identical on all machines if `radiance` is.
[[nodiscard]] EnvironmentLightDesc painted_environment(
    const PaintedSize& size, const std::function<double(const glm::dvec3&)>& radiance);

/// Returns 0 for x <= 0, 1 for x >= 1, and a smooth transition between.
[[nodiscard]] double smooth_step(double x);

}  // namespace bdpt
