#pragma once

#include <bdpt/error.h>
#include <bdpt/fields.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

namespace bdpt {

/// Throws `Error` (invalid_input) with the concatenated parts as message.
template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts)
{
    std::ostringstream message;
    (message << ... << parts);
    throw Error(ErrorCode::invalid_input, message.str());
}

/// Returns a label such as `mesh 3 "chair"`.
[[nodiscard]] inline std::string label(std::string_view kind, std::size_t index,
                                       const std::string& name)
{
    std::string text = std::string(kind) + " " + std::to_string(index);
    return name.empty() ? text : text + " \"" + name + "\"";
}

/// Returns a label such as `spot light 2 "stage"`.
template <typename Light>
[[nodiscard]] std::string light_label(const Light& light, std::size_t index)
{
    if constexpr (requires { light.name; }) {
        return label(Light::kind, index, light.name);
    } else {
        return label(Light::kind, index, "");
    }
}

/// Returns the number of pixels of an image.
[[nodiscard]] inline std::size_t area(int width, int height)
{
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// Tests whether `count` values are finite.
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
inline void check_range(const std::string& item, std::string_view what, float value, float low,
                        float high)
{
    if (!(value >= low && value <= high)) {
        fail(item, ": ", what, " is ", value, ", not in [", low, ", ", high, "]");
    }
}

/// Checks all channels of a colour, from 0 to `high`.
template <typename Color>
void check_color(const std::string& item, std::string_view what, const Color& value, float high)
{
    for (int c = 0; c < Color::length(); ++c) {
        check_range(item, what, value[c], 0.0f, high);
    }
}

/// Throws unless the number, or each channel of the colour, is within the limits.
template <typename T>
void check_limits(const std::string& item, std::string_view what, const T& value,
                  const Limits& limits)
{
    if constexpr (std::is_same_v<T, float>) {
        if (!limits.low_is_excluded) {
            check_range(item, what, value, limits.low, limits.high);
        } else if (!(value > limits.low && value <= limits.high)) {
            fail(item, ": ", what, " is ", value, ", but must be above ", limits.low);
        }
    } else {
        for (int c = 0; c < T::length(); ++c) {
            check_limits(item, what, value[c], limits);
        }
    }
}

/// Checks the numbers of a description that have limits in its list of fields.
template <HasFields Desc>
void check_own_limits(const std::string& item, const Desc& desc)
{
    for_each_field(desc, [&item](const auto& field, const auto& value) {
        if constexpr (requires { field.limits; }) {
            check_limits(item, field.name, value, field.limits);
        }
    });
}

/// Largest finite value.
inline constexpr float any_positive = std::numeric_limits<float>::max();

}  // namespace bdpt
