#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <array>

namespace bdpt::io {

/// Six images of all that is around, in the order +x, -x, +y, -y, +z, -z: each is what one sees
/// in that direction. +y is up in the images of the sides, -z in that of +y, and +z in that of -y
/// [EXT_lights_image_based, "Prefiltered Specular Radiance Cubemaps": the faces of OpenGL,
/// flipped].
struct CubeMap {
    std::array<Image, 6> faces;

    /// Bilinear within the face that the direction, of any length but 0, meets.
    [[nodiscard]] Rgb lookup(const Vec3& direction) const;
};

/// The same with half as many texels a side, each the mean of four.
[[nodiscard]] CubeMap halved(const CubeMap& cube);

/// The same as an equirectangular image, as `EnvironmentLightDesc` has it, twice as wide as high.
/// Each texel is the mean over its solid angle.
[[nodiscard]] Image to_equirectangular(const CubeMap& cube, int height);

}  // namespace bdpt::io
