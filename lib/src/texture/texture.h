#pragma once

#include "math/frame.h"
#include "texture/texel_coding.h"

#include <bdpt/image.h>
#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {

/// Calls its second argument for parts [begin, end) that make up [0, count), on any number of
/// threads, and returns when all are done.
using ForRows = std::function<void(int count, const std::function<void(int begin, int end)>&)>;

/// Returns a copy of half the width and height, rounded down but at least 1, of the same type and
/// channels: each texel is the mean of the texels it covers, in linear values.
[[nodiscard]] TexelImage half_size(const TexelImage& image, Encoding encoding,
                                   const ForRows& for_rows);

/// Smaller copies of images, each created on first use. Copying this object copies those that exist
/// by then.
class MipMaps {
public:
    explicit MipMaps(ForRows for_rows) : for_rows_(std::move(for_rows)) {}

    /// Returns copies of image number `index`, from half the size down to one texel; empty for an
    /// image of one texel. They stay valid as long as this object, or a later copy of it.
    [[nodiscard]] std::span<const TexelImage> of(std::size_t index, const TexelImage& image,
                                                 Encoding encoding);

private:
    ForRows for_rows_;
    std::map<std::pair<std::size_t, Encoding>, std::shared_ptr<const std::vector<TexelImage>>>
        copies_;
};

/// An image as used by one material slot: transform, wrap modes, decoding, bilinear filter. Refers
/// to the image, which must outlive it and have at least one texel.
class Texture {
public:
    /// `coarser` holds copies of the image, each half as wide as the one before, for lookups with a
    /// footprint; may be empty.
    Texture(const TextureRef& ref, const TexelImage& image, Encoding encoding,
            std::span<const TexelImage> coarser = {});

    /// Returns linear RGBA in [0, 1], radiance of any size, at the surface's own coordinates. (0,
    /// 0) is the image's upper left corner and v grows downwards; texel centres lie at (i + 0.5) /
    /// size; texels are decoded before they are interpolated. A coordinate that is not finite or
    /// beyond 4e6 counts as 0.
    [[nodiscard]] Vec4 lookup(const std::array<Vec2, 2>& uv) const noexcept
    {
        return bilinear(*image_, uv);
    }
    /// Looks up the coarsest copy whose texels are at most half as wide as the footprint in its
    /// narrowest direction. Null is a footprint without extent.
    [[nodiscard]] Vec4 lookup(const std::array<Vec2, 2>& uv,
                              const UvFootprint* footprint) const noexcept
    {
        return bilinear(footprint == nullptr || coarser_.empty() ? *image_ : level(*footprint), uv);
    }

    /// Starts to load the texels of a `lookup` without a footprint into the cache.
    void prefetch(const std::array<Vec2, 2>& uv) const noexcept;

    /// Returns the position of a `lookup`, in texels of the infinitely repeated image.
    [[nodiscard]] Vec2 texel_position(const std::array<Vec2, 2>& uv) const noexcept;

    /// Returns the average over the whole image.
    [[nodiscard]] Vec4 mean() const;

    /// Returns the minimum and maximum alpha of the image.
    [[nodiscard]] std::pair<float, float> alpha_range() const;

    /// Returns 0 or 1.
    [[nodiscard]] int uv_set() const noexcept { return uv_set_; }

private:
    [[nodiscard]] Vec2 transformed(const std::array<Vec2, 2>& uv) const noexcept;
    [[nodiscard]] const TexelImage& level(const UvFootprint& footprint) const noexcept;
    [[nodiscard]] Vec4 bilinear(const TexelImage& image,
                                const std::array<Vec2, 2>& uv) const noexcept;
    template <typename Visit>
    void for_each_texel(const Visit& visit) const;

    const TexelImage* image_;
    std::span<const TexelImage> coarser_;
    TexelCoding coding_;
    int uv_set_;
    Wrap wrap_u_;
    Wrap wrap_v_;
    Vec2 u_axis_;  ///< column of the transform that multiplies u
    Vec2 v_axis_;
    Vec2 offset_;
};

/// The images of a scene, and optionally their smaller copies. Refers to both.
struct TextureImages {
    TextureImages() = default;
    TextureImages(std::span<const TexelImage> all, MipMaps* copies = nullptr)
        : images(all), mip_maps(copies)
    {}
    TextureImages(const std::vector<TexelImage>& all, MipMaps* copies = nullptr)
        : images(all), mip_maps(copies)
    {}

    /// Returns the images without the copies.
    [[nodiscard]] TextureImages at_full_size() const { return {images}; }

    std::span<const TexelImage> images;
    MipMaps* mip_maps = nullptr;
};

/// Returns the texture of a slot, if it has one.
[[nodiscard]] inline std::optional<Texture> make_texture(const std::optional<TextureRef>& ref,
                                                         const TextureImages& texture_images,
                                                         Encoding encoding)
{
    if (!ref) {
        return std::nullopt;
    }
    const auto index = static_cast<std::size_t>(ref->image);
    const TexelImage& image = texture_images.images[index];
    return texture_images.mip_maps == nullptr
               ? Texture(*ref, image, encoding)
               : Texture(*ref, image, encoding,
                         texture_images.mip_maps->of(index, image, encoding));
}

}  // namespace bdpt
