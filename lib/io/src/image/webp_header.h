#pragma once

#include "file/bytes.h"

namespace bdpt::io {

/// Is it a WebP image, by its first bytes?
[[nodiscard]] bool is_webp(ByteView file);

struct EncodedImageSize {
    int width = 0;
    int height = 0;
};

/// Size of a WebP image from its header [RFC 9649, sec. 2.5 to 2.7]: opening one with OpenImageIO
/// decodes it. Throws std::runtime_error when the header is broken.
[[nodiscard]] EncodedImageSize webp_size(ByteView file);

}  // namespace bdpt::io
