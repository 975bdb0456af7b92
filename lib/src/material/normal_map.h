#pragma once

#include "material/shading_point.h"
#include "texture/texture.h"

#include <optional>

namespace bdpt {

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

private:
    Texture map_;
    float scale_;
};

/// Returns the map of a slot, if it has one; at full size, as averaged normals are those of a
/// smoother surface.
[[nodiscard]] std::optional<NormalMap> make_normal_map(const std::optional<TextureRef>& ref,
                                                       float scale, const TextureImages& images);

}  // namespace bdpt
