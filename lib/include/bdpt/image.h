#pragma once

/// @file
/// Holds the pixels of images, layers and textures.
///
/// @code{.cpp}
/// void print_centre(const bdpt::Image& image)
/// {
///     const bdpt::Rgb radiance = image.at(image.width / 2, image.height / 2);
///     std::cout << radiance.r << ' ' << radiance.g << ' ' << radiance.b << " nit\n";
/// }
/// @endcode

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

/// Row-major linear RGB pixels; row 0 is the top row.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;  ///< width * height

    /// Returns a pixel; `x` in [0, width), `y` in [0, height).
    [[nodiscard]] const Rgb& at(int x, int y) const
    {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Named channels of an image, as in multi-layer files.
struct Layer {
    std::string name;      ///< "normal"; empty: the main layer
    std::string channels;  ///< one letter each, in the order of the values: "XYZ"
    int width = 0;
    int height = 0;
    std::vector<float> values;  ///< row-major from the top left, channels interleaved
};

/// Storage type of an image's values.
enum class TexelType : std::uint8_t {
    unorm8,   ///< 255 is 1
    unorm16,  ///< 65535 is 1
    half,     ///< IEEE 754 binary16
    float32,
};

/// Returns the bytes per value.
[[nodiscard]] constexpr std::size_t count_value_bytes(TexelType type) noexcept
{
    return type == TexelType::unorm8 ? 1 : type == TexelType::float32 ? 4 : 2;
}

/// Row-major texels as stored in an image file; row 0 is the top row. The material slot that refers
/// to the image decides whether integers are sRGB-encoded; alpha, halves and floats are linear.
/// Halves and floats must be finite and not negative; values above 1 have an effect in emission
/// only.
struct TexelImage {
    int width = 0;
    int height = 0;
    /// width * height * channels values of `type`, in the byte order of the machine.
    std::vector<std::uint8_t> bytes;
    int channels = 4;  ///< 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA
    TexelType type = TexelType::unorm8;
};

}  // namespace bdpt
