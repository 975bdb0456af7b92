#pragma once

#include <bdpt/image.h>

#include <cstdint>

namespace bdpt {

/// How the red, green and blue of an image are stored; alpha is always linear.
enum class Encoding : std::uint8_t {
    linear,
    srgb,      ///< integers are; halves and floats are linear
    radiance,  ///< the same, and halves and floats may be above 1
};

/// What stored values mean.
struct TexelCoding {
    const float* table = nullptr;  ///< of each integer; null: linear 16 bits, or not integers
    float most = 1.0f;             ///< greater halves and floats count as this
};

/// Tables stay valid until the end of the process.
[[nodiscard]] TexelCoding coding_of(TexelType type, Encoding encoding);

/// Of 8-bit values that are linear, such as alpha.
[[nodiscard]] const float* linear_table_8() noexcept;

}  // namespace bdpt
