#pragma once

#include <bdpt/image.h>

#include <string>

namespace bdpt::eval {

/// An image to measure, with its name for messages.
struct NamedInput {
    std::string name;
    const Image& image;
    /// Position in the whole image [pixels].
    int x0 = 0;
    int y0 = 0;
};

/// Throws `Error` (invalid_input) for an image without pixels, and for one with NaN or infinity,
/// naming the pixel.
void check_image(const NamedInput& input);

/// Throws as the other overload does, and for an image whose size differs from its reference's.
void check_image(const NamedInput& input, const NamedInput& reference);

}  // namespace bdpt::eval
