#pragma once

#include "math/footprint.h"
#include "math/wavelength.h"

#include <bdpt/types.h>

#include <array>

namespace bdpt {

/// Properties of a surface point that a material needs.
struct ShadingPoint {
    Vec3 ng{0.0f, 0.0f, 1.0f};  ///< unit, front side
    Vec3 ns{0.0f, 0.0f, 1.0f};  ///< unit, interpolated; in the hemisphere of ng
    Vec4 tangent{0.0f};         ///< xyz (any length, not parallel to ns) and handedness; zero: none
    std::array<Vec2, 2> uv{};
    Vec4 color{1.0f};  ///< vertex colour, linear
    Wavelength wavelength = Wavelength::green;
    Vec3 wo{0.0f, 0.0f, 1.0f};  ///< unit, towards the origin of the walk
    /// Texture footprint of a pixel, for mip-mapped textures.
    const UvFootprint* footprint = nullptr;
};

/// Coordinates for the lookup of textures and vertex colours.
struct TexturePoint {
    std::array<Vec2, 2> uv{};
    Vec4 color{1.0f};  ///< vertex colour, linear
};

}  // namespace bdpt
