#include "options/values/medium_values.h"

#include <bdpt/medium_desc.h>
#include <fmt/core.h>

#include <optional>

#include "options/arguments.h"

namespace bdpt::app {

Rgb color_of(const char* option, const std::string& text, float most, const std::string& expected)
{
    const std::optional<float> grey = parse_float(text);
    const std::optional<Vec3> color = grey ? Vec3(*grey) : parse_vec3(text);
    for (int channel = 0; channel < 3; ++channel) {
        if (!color || !((*color)[channel] >= 0.0f && (*color)[channel] <= most)) {
            reject(option, text, expected);
        }
    }
    return *color;
}

Rgb albedo_of(const char* option, const std::string& text)
{
    return color_of(option, text, 1.0f, "a number in [0, 1], or three");
}

float anisotropy_of(const char* option, double value)
{
    constexpr auto most = static_cast<double>(most_anisotropy);
    if (!(value >= -most && value <= most)) {
        reject(option, fmt::format("{}", value),
               fmt::format("a number from {:.4f} to {:.4f}", -most, most));
    }
    return static_cast<float>(value);
}

}  // namespace bdpt::app
