#pragma once

#include <algorithm>
#include <cmath>

namespace bdpt::io {

/// Encodes a linear value [IEC 61966-2-1], which is clamped, to [0, 1]; NaN gives 0.
inline float srgb_code(float linear)
{
    const float value = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

/// Decodes an sRGB value: the inverse of `srgb_code`.
inline float srgb_linear(float code)
{
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace bdpt::io
