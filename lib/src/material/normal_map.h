#pragma once

#include "math/frame.h"
#include "math/rgb.h"
#include "texture/texture.h"

#include <bdpt/types.h>

#include <array>
#include <optional>

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

/// The unit tangent and bitangent of a point, perpendicular to `ns` [glTF 2.0, sec. 3.9.3]; nullopt
/// if it has no tangent.
struct TangentAxes {
    Vec3 tangent;
    Vec3 bitangent;
};
[[nodiscard]] std::optional<TangentAxes> tangent_axes(const ShadingPoint& point) noexcept;

/// An image of normals in tangent space [glTF 2.0, sec. 3.9.3].
class NormalMap {
public:
    /// `scale` multiplies x and y.
    NormalMap(const Texture& map, float scale) : map_(map), scale_(scale) {}

    /// Returns a unit normal clearly on the side of `ns`: normals below are tilted up as little as
    /// possible. `ns` itself if the point has no tangent.
    [[nodiscard]] Vec3 normal(const ShadingPoint& point) const noexcept;
    [[nodiscard]] int uv_set() const noexcept { return map_.uv_set(); }
    void prefetch(const std::array<Vec2, 2>& uv) const noexcept { map_.prefetch(uv); }

private:
    Texture map_;
    float scale_;
};

/// Returns the map of a slot, if it has one; at full size, as averaged normals are those of a
/// smoother surface.
[[nodiscard]] std::optional<NormalMap> make_normal_map(const std::optional<TextureRef>& ref,
                                                       float scale, const TextureImages& images);

}  // namespace bdpt
