#pragma once

/// @file
/// Keeps decoded images for the next time that a file is loaded.
///
/// @code{.cpp}
/// bdpt::io::GltfOptions options;
/// options.images = std::make_shared<bdpt::io::ImageCache>(std::uint64_t{1} << 30);
/// for (int frame = 0; frame < 48; ++frame) {
///     options.time = frame / 24.0;
///     const bdpt::Scene scene(bdpt::io::load_gltf("walk.glb", options).scene);
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/part/content_hash.h>

#include <cstdint>
#include <map>
#include <utility>

namespace bdpt::io {

/// Cache of decoded images, keyed by the hash of their encoded bytes, for callers that load a file
/// repeatedly, as for the frames of an animation. Used by one load at a time.
class BDPT_EXPORT ImageCache {
public:
    /// Keeps images of up to `max_bytes` in total: the first ones, as repeated loads of a file
    /// request them in the same order.
    explicit ImageCache(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

    /// Returns the image decoded from bytes of this hash; null if it was not kept.
    [[nodiscard]] const TexelImage* find(const ContentHash& encoded) const;
    /// Keeps a copy of `image`, if there is room.
    void keep(const ContentHash& encoded, const TexelImage& image);
    /// Returns the memory of the images [bytes].
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    std::uint64_t max_bytes_;
    std::uint64_t bytes_ = 0;
    std::map<std::pair<std::uint64_t, std::uint64_t>, TexelImage> images_;
};

}  // namespace bdpt::io
