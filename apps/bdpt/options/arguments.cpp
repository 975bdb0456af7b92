#include "options/arguments.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace bdpt::app {
namespace {

/// All of `text` as one number.
template <typename Number>
std::optional<Number> parse_number(std::string_view text)
{
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || text.empty()) {
        return std::nullopt;
    }
    return value;
}

}  // namespace

std::optional<Size> parse_size(std::string_view text)
{
    constexpr int largest = 65535;
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos) {
        return std::nullopt;
    }
    const auto width = parse_number<int>(text.substr(0, cross));
    const auto height = parse_number<int>(text.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > largest || *height > largest) {
        return std::nullopt;
    }
    return Size{*width, *height};
}

std::optional<double> parse_duration(std::string_view text)
{
    double unit = 1.0;
    if (!text.empty()) {
        const char last = text.back();
        unit = last == 'm' ? 60.0 : last == 'h' ? 3600.0 : 1.0;
        text.remove_suffix(last == 's' || last == 'm' || last == 'h' ? 1 : 0);
    }
    const auto count = parse_number<double>(text);
    if (!count || !std::isfinite(*count) || *count <= 0.0) {
        return std::nullopt;
    }
    return *count * unit;
}

std::optional<std::uint64_t> parse_bytes(std::string_view text)
{
    constexpr std::string_view units = "KMGT";
    double unit = 1.0;
    if (!text.empty()) {
        const std::size_t power = units.find(text.back());
        if (power != std::string_view::npos) {
            unit = std::ldexp(1.0, 10 * (static_cast<int>(power) + 1));
            text.remove_suffix(1);
        }
    }
    const auto count = parse_number<double>(text);
    constexpr double too_many = 0x1p63;
    if (!count || !(*count * unit >= 1.0 && *count * unit < too_many)) {
        return std::nullopt;
    }
    return static_cast<std::uint64_t>(*count * unit);
}

std::optional<double> parse_share(std::string_view text)
{
    const bool percent = text.ends_with('%');
    text.remove_suffix(percent ? 1 : 0);
    const auto number = parse_number<double>(text);
    const double share = number ? *number / (percent ? 100.0 : 1.0) : 0.0;
    return share > 0.0 && share <= 1.0 ? std::optional(share) : std::nullopt;
}

std::optional<Vec3> parse_vec3(std::string_view text)
{
    Vec3 result(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (axis == 2)) {
            return std::nullopt;
        }
        const auto value = parse_float(text.substr(0, comma));
        if (!value) {
            return std::nullopt;
        }
        result[axis] = *value;
        text.remove_prefix(axis == 2 ? text.size() : comma + 1);
    }
    return result;
}

std::optional<double> parse_double(std::string_view text)
{
    const auto value = parse_number<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<float> parse_float(std::string_view text)
{
    const auto value = parse_number<float>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::size_t> parse_index(std::string_view text)
{
    return parse_number<std::size_t>(text);
}

}  // namespace bdpt::app
