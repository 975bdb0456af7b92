#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <array>
#include <cmath>

namespace bdpt::io {

/// Six images of the surroundings, in the order +x, -x, +y, -y, +z, -z: each is the view in that
/// direction. +y is up in the images of the sides, -z in that of +y, and +z in that of -y
/// [EXT_lights_image_based, "Prefiltered Specular Radiance Cubemaps": the faces of OpenGL,
/// flipped].
struct CubeMap {
    std::array<Image, 6> faces;

    /// Looks up a direction of any length but 0, bilinearly within its face.
    [[nodiscard]] Rgb lookup(const Vec3& direction) const;
};

/// Halves the resolution: each texel is the mean of four.
[[nodiscard]] CubeMap halved(const CubeMap& cube);

/// Resamples to an equirectangular image, as in `EnvironmentLightDesc`, twice as wide as high. Each
/// texel is the mean over its solid angle.
[[nodiscard]] Image to_equirectangular(const CubeMap& cube, int height);

/// A point of the unit circle.
struct CirclePoint {
    double sin = 0.0;
    double cos = 1.0;
};

/// Returns the point at a fraction of a turn, accurate to the last digits and equal on all
/// machines, unlike the sine of the C library.
[[nodiscard]] inline CirclePoint circle_point(double turns)
{
    const double quadrant = std::floor(4.0 * turns + 0.5);
    const double x = (turns - 0.25 * quadrant) * 6.283185307179586;
    // Taylor series on |x| <= pi/4, evaluated from the last term.
    const double x2 = x * x;
    double s = 1.0;
    double c = 1.0;
    for (int n = 16; n >= 2; n -= 2) {
        s = 1.0 - s * x2 / (n * (n + 1));
        c = 1.0 - c * x2 / (n * (n - 1));
    }
    s *= x;
    switch (static_cast<int>(quadrant - 4.0 * std::floor(0.25 * quadrant))) {
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        case 3:
            return {-c, s};
        default:
            return {s, c};
    }
}

}  // namespace bdpt::io
