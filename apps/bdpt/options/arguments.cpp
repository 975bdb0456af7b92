#include "options/arguments.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bdpt::app {
namespace {

/// Parses "x,y,z", all finite.
template <typename Vector>
std::optional<Vector> parse_numbers(std::string_view text)
{
    const std::vector<std::string_view> parts = split(text, ',');
    Vector result(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto value =
            parts.size() == 3
                ? parse_number<typename Vector::value_type>(parts[static_cast<std::size_t>(axis)])
                : std::nullopt;
        if (!value || !std::isfinite(*value)) {
            return std::nullopt;
        }
        result[axis] = *value;
    }
    return result;
}

}  // namespace

std::string lower_case(std::string_view text)
{
    std::string result(text);
    for (char& c : result) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (std::size_t end = text.find(separator); end != std::string_view::npos;
         end = text.find(separator)) {
        parts.push_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    parts.push_back(text);
    return parts;
}

std::optional<Size> parse_size(std::string_view text)
{
    constexpr int largest = 65535;
    const std::size_t cross = text.find_first_of("xX");
    const bool square = cross == std::string_view::npos;
    const auto width = parse_number<int>(text.substr(0, cross));
    const auto height = square ? width : parse_number<int>(text.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > largest || *height > largest) {
        return std::nullopt;
    }
    return Size{*width, *height};
}

std::optional<double> parse_duration(std::string_view text)
{
    const std::string words = lower_case(text);
    std::string_view rest = words;
    double seconds = 0.0;
    // With several parts each has a unit, longer units first.
    bool is_first = true;
    for (const auto& [name, unit] :
         {std::pair{'h', 3600.0}, std::pair{'m', 60.0}, std::pair{'s', 1.0}}) {
        const std::size_t end = rest.find(name);
        const bool plain = name == 's' && is_first && end == std::string_view::npos;
        if (end == std::string_view::npos && !plain) {
            continue;
        }
        const auto count = parse_number<double>(rest.substr(0, end));
        if (!count || !std::isfinite(*count) || *count < 0.0) {
            return std::nullopt;
        }
        seconds += *count * unit;
        rest.remove_prefix(plain ? rest.size() : end + 1);
        is_first = false;
    }
    return rest.empty() && seconds > 0.0 && std::isfinite(seconds) ? std::optional(seconds)
                                                                   : std::nullopt;
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
    const bool has_sign = text.ends_with('%');
    text.remove_suffix(has_sign ? 1 : 0);
    const auto number = parse_number<double>(text);
    if (!number) {
        return std::nullopt;
    }
    // A noise of 100 % and more is not useful.
    const double share = *number / (has_sign || *number >= 1.0 ? 100.0 : 1.0);
    return share > 0.0 && share <= 1.0 ? std::optional(share) : std::nullopt;
}

std::optional<Vec3> parse_vec3(std::string_view text)
{
    return parse_numbers<Vec3>(text);
}

std::optional<DVec3> parse_dvec3(std::string_view text)
{
    return parse_vec3(text) ? parse_numbers<DVec3>(text) : std::nullopt;
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

std::optional<DisplayAddress> parse_address(const std::string& text)
{
    constexpr std::size_t max_port = 65535;
    DisplayAddress address{.host = text, .port = "14158"};
    const std::size_t bracket = text.find(']');
    const bool bracketed = text.starts_with('[') && bracket != std::string::npos;
    const std::size_t colon = text.find(':', bracketed ? bracket : 0);
    if (colon != std::string::npos) {
        address.host = text.substr(0, colon);
        address.port = text.substr(colon + 1);
        const std::optional<std::size_t> port = parse_index(address.port);
        if (!port || *port < 1 || *port > max_port) {
            return std::nullopt;
        }
    }
    if (bracketed) {
        if (address.host.size() != bracket + 1) {
            return std::nullopt;  // text between the bracket and the colon
        }
        address.host = address.host.substr(1, bracket - 1);
    }
    if (address.host.empty()) {
        address.host = "localhost";
    }
    const bool plain = std::none_of(address.host.begin(), address.host.end(), [](unsigned char c) {
        return c <= ' ' || c == '/' || c == '[' || c == ']';
    });
    return plain && !text.empty() ? std::optional(address) : std::nullopt;
}

}  // namespace bdpt::app
