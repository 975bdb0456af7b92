#pragma once

#include "math/footprint.h"
#include "math/wavelength.h"

#include <bdpt/types.h>

#include <array>

namespace bdpt {

/// What a material needs to know of a surface point.
struct ShadingPoint {
    Vec3 ng{0.0f, 0.0f, 1.0f};  ///< unit, front side
    Vec3 ns{0.0f, 0.0f, 1.0f};  ///< unit, interpolated; in the hemisphere of ng
    Vec4 tangent{0.0f};         ///< xyz (any length, not parallel to ns) and handedness; zero: none
    std::array<Vec2, 2> uv{};
    Vec4 color{1.0f};  ///< vertex colour, linear
    Wavelength wavelength = Wavelength::green;
    Vec3 wo{0.0f, 0.0f, 1.0f};  ///< unit, towards where the walk came from
    /// What a pixel covers of the textures, where they are mip-mapped.
    const UvFootprint* footprint = nullptr;
};

/// What textures and vertex colours are looked up by.
struct TexturePoint {
    std::array<Vec2, 2> uv{};
    Vec4 color{1.0f};  ///< vertex colour, linear
};

}  // namespace bdpt
