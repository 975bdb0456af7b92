#include <bdpt/io/gltf.h>

namespace bdpt::io {

const TexelImage* ImageCache::find(const ContentHash& encoded) const
{
    const auto found = images_.find({encoded.high, encoded.low});
    return found != images_.end() ? &found->second : nullptr;
}

void ImageCache::keep(const ContentHash& encoded, const TexelImage& image)
{
    if (image.bytes.size() > max_bytes_ - bytes_) {
        return;
    }
    if (images_.try_emplace({encoded.high, encoded.low}, image).second) {
        bytes_ += image.bytes.size();
    }
}

}  // namespace bdpt::io
