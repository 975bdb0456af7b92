#pragma once

#include "material/shading_point.h"
#include "texture/texture.h"

#include <optional>

namespace bdpt {

/// The unit tangent and bitangent of a point, at right angles to `ns` [glTF 2.0, sec. 3.9.3]; none
/// where it has no tangent.
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

    /// Unit, and clearly on the side of `ns`: what leads below is turned up as little as possible.
    /// `ns` itself where the point has no tangent.
    [[nodiscard]] Vec3 normal(const ShadingPoint& point) const noexcept;
    [[nodiscard]] int uv_set() const noexcept { return map_.uv_set(); }

private:
    Texture map_;
    float scale_;
};

/// The map of a slot, if it has one; at full size, as the means of normals are those of a smoother
/// surface.
[[nodiscard]] std::optional<NormalMap> make_normal_map(const std::optional<TextureRef>& ref,
                                                       float scale, const TextureImages& images);

}  // namespace bdpt
