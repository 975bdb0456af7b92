#pragma once

#include "texture/texel_coding.h"

#include <bdpt/image.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
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

}  // namespace bdpt
