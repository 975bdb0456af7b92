#pragma once

#include <bdpt/image.h>

#include <string>

namespace bdpt::eval {

/// An image to be measured, with what messages call it.
struct NamedInput {
    std::string name;
    const Image& image;
    /// Where it lies in the whole image [pixels].
    int x0 = 0;
    int y0 = 0;
};

/// Throws `Error` (invalid_input) for an image without pixels, and for one with NaN or infinity,
/// naming the pixel.
void check_image(const NamedInput& input);

/// The same, and for an image that does not have the size of its reference.
void check_image(const NamedInput& input, const NamedInput& reference);

}  // namespace bdpt::eval
