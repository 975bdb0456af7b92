#pragma once

#include <bdpt/image.h>

#include <cstdint>

namespace bdpt {

/// Encoding of an image's red, green and blue; alpha is always linear.
enum class Encoding : std::uint8_t {
    linear,
    srgb,      ///< sRGB integers; halves and floats are linear
    radiance,  ///< as `srgb`, and halves and floats may exceed 1
};

/// Decoding of stored values.
struct TexelCoding {
    const float* table = nullptr;  ///< decoded integers; null: linear 16 bits, or not integers
    float most = 1.0f;             ///< upper bound to which halves and floats are clamped
};

/// Returns the decoding of a type. Tables stay valid until the end of the process.
[[nodiscard]] TexelCoding find_coding(TexelType type, Encoding encoding);

/// Returns the table of linear 8-bit values, such as alpha.
[[nodiscard]] const float* linear_table_8() noexcept;

}  // namespace bdpt
