#pragma once

#include <bdpt/image.h>

#include <string>

namespace bdpt {

/// Throws `Error` (invalid_input) whose message begins with `item` if the image has no texels, a
/// wrong number of bytes, or values that textures cannot have.
void check_texels(const TexelImage& image, const std::string& item);

}  // namespace bdpt
