#pragma once

/// @file
/// Writes the values of options as the command takes them.
///
/// @code{.cpp}
/// const bdpt::FilterOptions filter = {.kind = bdpt::FilterKind::gaussian, .radius = 2.0f};
/// std::cout << "--filter " << bdpt::option_text(filter) << '\n';  // --filter gaussian:2
/// @endcode

#include <bdpt/options/option_fields.h>

#include <array>
#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt {

// Values of options as text, in the format that the command line accepts.

/// Formats a number with the fewest digits that identify it among all numbers of its type.
template <typename T>
requires std::is_arithmetic_v<T>
[[nodiscard]] inline std::string option_text(T value)
{
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

/// Returns the name of an enumerator.
template <HasEnumerators Enum>
[[nodiscard]] inline std::string option_text(Enum value)
{
    return std::string(to_name(value));
}

/// Formats a strategy: "s2t1".
[[nodiscard]] inline std::string option_text(const Strategy& strategy)
{
    return "s" + option_text(strategy.s) + "t" + option_text(strategy.t);
}

/// Formats a sample range: "0:64".
[[nodiscard]] inline std::string option_text(const SampleRange& samples)
{
    return option_text(samples.begin) + ":" + option_text(samples.end);
}

/// Formats a rectangle: "x0,y0,x1,y1".
[[nodiscard]] inline std::string option_text(const PixelRect& rect)
{
    return option_text(rect.x0) + "," + option_text(rect.y0) + "," + option_text(rect.x1) + "," +
           option_text(rect.y1);
}

/// Formats a filter: "gaussian", or "gaussian:2" with a radius.
[[nodiscard]] inline std::string option_text(const FilterOptions& filter)
{
    const std::string kind = option_text(filter.kind);
    return filter.radius ? kind + ":" + option_text(*filter.radius) : kind;
}

/// Formats a set of AOVs: "albedo,normal", or "none".
[[nodiscard]] inline std::string option_text(const AovSet& aovs)
{
    std::string text;
    for (const auto& [aov, name] : enumerators<Aov>) {
        if (aovs.contains(aov)) {
            text += (text.empty() ? "" : ",") + std::string(name);
        }
    }
    return text.empty() ? "none" : text;
}

/// Formats an optional value; "none" if it is empty.
template <typename T>
[[nodiscard]] inline std::string option_text(const std::optional<T>& value)
{
    return value ? option_text(*value) : "none";
}

/// Formats a list: "s1t1,s0t4", or "none".
template <typename T>
[[nodiscard]] inline std::string option_text(const std::vector<T>& values)
{
    std::string text;
    for (const T& value : values) {
        text += (text.empty() ? "" : ",") + option_text(value);
    }
    return text.empty() ? "none" : text;
}

}  // namespace bdpt
