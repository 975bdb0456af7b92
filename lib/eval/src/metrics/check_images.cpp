#include "metrics/check_images.h"

#include <bdpt/error.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt::eval {
namespace {

std::string size_text(const Image& image)
{
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

}  // namespace

void check_image(const NamedInput& input)
{
    constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
    if (input.image.pixels.empty()) {
        throw Error(ErrorCode::invalid_input, input.name + ": has no pixels");
    }
    for (int y = 0; y < input.image.height; ++y) {
        for (int x = 0; x < input.image.width; ++x) {
            for (std::size_t c = 0; c < channels.size(); ++c) {
                const float value = input.image.at(x, y)[static_cast<int>(c)];
                if (!std::isfinite(value)) {
                    throw Error(ErrorCode::invalid_input,
                                input.name + ": pixel (" + std::to_string(input.x0 + x) + ", " +
                                    std::to_string(input.y0 + y) + ") has " +
                                    std::to_string(value) + " in channel " + channels[c]);
                }
            }
        }
    }
}

void check_image(const NamedInput& input, const NamedInput& reference)
{
    if (input.image.width != reference.image.width ||
        input.image.height != reference.image.height) {
        throw Error(ErrorCode::invalid_input, input.name + ": has " + size_text(input.image) +
                                                  " pixels, but " + reference.name + " has " +
                                                  size_text(reference.image));
    }
    check_image(input);
}

}  // namespace bdpt::eval
