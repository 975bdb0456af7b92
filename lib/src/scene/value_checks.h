#pragma once

#include <bdpt/error.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

namespace bdpt {

/// Throws `Error` (invalid_input) with these parts as its text.
template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts)
{
    std::ostringstream message;
    (message << ... << parts);
    throw Error(ErrorCode::invalid_input, message.str());
}

/// `mesh 3 "chair"`
[[nodiscard]] inline std::string label(std::string_view kind, std::size_t index,
                                       const std::string& name)
{
    std::string text = std::string(kind) + " " + std::to_string(index);
    return name.empty() ? text : text + " \"" + name + "\"";
}

/// Pixels of a picture.
[[nodiscard]] inline std::size_t area(int width, int height)
{
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// Are `count` values?
[[nodiscard]] inline bool all_finite(const float* values, int count)
{
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

/// Throws unless the value is in [low, high]; a NaN is in no range.
inline void check_range(const std::string& item, const char* what, float value, float low,
                        float high)
{
    if (!(value >= low && value <= high)) {
        fail(item, ": ", what, " is ", value, ", not in [", low, ", ", high, "]");
    }
}

/// The same for all channels, from 0.
template <typename Color>
void check_color(const std::string& item, const char* what, const Color& value, float high)
{
    for (int c = 0; c < Color::length(); ++c) {
        check_range(item, what, value[c], 0.0f, high);
    }
}

/// The greatest of all values that are finite.
inline constexpr float any_positive = std::numeric_limits<float>::max();

}  // namespace bdpt
