#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <array>

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

}  // namespace bdpt::io
