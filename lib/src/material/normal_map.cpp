#include "material/normal_map.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {
namespace {

/// Returns `normal`, tilted towards `above` as little as needed to lie clearly on its side.
[[nodiscard]] Vec3 kept_on_side(Vec3 normal, Vec3 above)
{
    constexpr float min_cosine = 0.01f;
    const float cosine = dot(normal, above);
    if (cosine >= min_cosine) {
        return normal;
    }
    const Vec3 along = normal - cosine * above;
    const float length = std::sqrt(dot(along, along));
    if (length < 1e-6f) {
        return above;  // straight from below: all directions of tilt are equivalent
    }
    return normalize(along * (std::sqrt(1.0f - min_cosine * min_cosine) / length) +
                     min_cosine * above);
}

}  // namespace

std::optional<TangentAxes> tangent_axes(const ShadingPoint& point) noexcept
{
    const Vec3 along(point.tangent);
    const Vec3 tangent = along - dot(along, point.ns) * point.ns;
    const float length2 = dot(tangent, tangent);
    if (!(length2 > 0.0f)) {
        return std::nullopt;
    }
    const Vec3 t = tangent / std::sqrt(length2);
    return TangentAxes{t, cross(point.ns, t) * point.tangent.w};
}

Vec3 NormalMap::normal(const ShadingPoint& point) const noexcept
{
    const std::optional<TangentAxes> axes = tangent_axes(point);
    if (!axes) {
        return point.ns;
    }
    const Vec3 n = 2.0f * Vec3(map_.lookup(point.uv)) - 1.0f;
    const Vec3 world =
        n.x * scale_ * axes->tangent + n.y * scale_ * axes->bitangent + n.z * point.ns;
    const float world2 = dot(world, world);
    return world2 > 0.0f ? kept_on_side(world / std::sqrt(world2), point.ns) : point.ns;
}

std::optional<NormalMap> make_normal_map(const std::optional<TextureRef>& ref, float scale,
                                         const TextureImages& images)
{
    const std::optional<Texture> map = make_texture(ref, images.at_full_size(), Encoding::linear);
    return map ? std::optional(NormalMap(*map, scale)) : std::nullopt;
}

}  // namespace bdpt
