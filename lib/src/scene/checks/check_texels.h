#pragma once

#include <bdpt/image.h>

#include <string>

namespace bdpt {

/// Throws `Error` (invalid_input) that begins with `item` when the image has no texels, another
/// number of bytes than they need, or values that textures cannot have.
void check_texels(const TexelImage& image, const std::string& item);

}  // namespace bdpt
