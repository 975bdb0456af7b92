#pragma once

#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace bdpt {

/// How the red, green and blue of a picture are stored; alpha is always linear.
enum class Encoding { linear, srgb };

/// A picture as one material slot sees it: transform, wrap modes, decoding, bilinear filter. Refers
/// to the image, which must outlive it and have at least one texel.
class Texture {
public:
    Texture(const TextureRef& ref, const TexelImage& image, Encoding encoding);

    /// Linear RGBA in [0, 1] at the surface's own coordinates. (0, 0) is the picture's upper left
    /// corner and v grows downwards; texel centres lie at (i + 0.5) / size; texels are decoded
    /// before they are mixed. A coordinate that is not finite or beyond 4e6 counts as 0.
    [[nodiscard]] Vec4 lookup(const std::array<Vec2, 2>& uv) const noexcept;

    /// Where `lookup` looks, in texels of the picture repeated without end.
    [[nodiscard]] Vec2 texel_position(const std::array<Vec2, 2>& uv) const noexcept;

    /// Average over the whole picture.
    [[nodiscard]] Vec4 mean() const;

    /// The least and the greatest alpha of the picture.
    [[nodiscard]] std::pair<float, float> alpha_range() const;

    /// 0 or 1
    [[nodiscard]] int uv_set() const noexcept { return uv_set_; }

private:
    [[nodiscard]] Vec2 transformed(const std::array<Vec2, 2>& uv) const noexcept;
    [[nodiscard]] Vec4 texel(int x, int y) const noexcept;

    const TexelImage* image_;
    const float* decode_;  ///< 256 values
    int uv_set_;
    Wrap wrap_u_;
    Wrap wrap_v_;
    Vec2 u_axis_;  ///< column of the transform that multiplies u
    Vec2 v_axis_;
    Vec2 offset_;
};

/// The texture of a slot, if it has one.
[[nodiscard]] inline std::optional<Texture> make_texture(const std::optional<TextureRef>& ref,
                                                         std::span<const TexelImage> images,
                                                         Encoding encoding)
{
    if (!ref) {
        return std::nullopt;
    }
    return Texture(*ref, images[static_cast<std::size_t>(ref->image)], encoding);
}

}  // namespace bdpt
