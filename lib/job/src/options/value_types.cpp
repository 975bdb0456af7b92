#include "options/value_types.h"

#include <bdpt/medium_desc.h>
#include <bdpt/part/sample_set.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "options/output_files.h"

namespace bdpt::job {
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

std::optional<NetworkAddress> parse_address(const std::string& text,
                                            const std::string& default_port)
{
    constexpr std::size_t max_port = 65535;
    NetworkAddress address{.host = text, .port = default_port};
    const std::size_t bracket = text.find(']');
    const bool bracketed = text.starts_with('[') && bracket != std::string::npos;
    const std::size_t colon = text.find(':', bracketed ? bracket : 0);
    if (colon != std::string::npos) {
        address.host = text.substr(0, colon);
        address.port = text.substr(colon + 1);
        const std::optional<std::size_t> port = parse_index(address.port);
        if (!port || *port > max_port || (*port == 0 && default_port != "0")) {
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

namespace {

/// Returns 1e3 and 1000.0 as "1000"; texts that are no whole number are unchanged.
std::string whole_spelling(std::string text)
{
    constexpr double exact = 0x1p53;
    const bool has_digits_only = text.find_first_of(".eE") == std::string::npos;
    const std::optional<double> value = has_digits_only ? std::nullopt : parse_number<double>(text);
    const bool is_whole = value && std::abs(*value) <= exact && *value == std::trunc(*value);
    return is_whole ? fmt::format("{:.0f}", *value) : text;
}

/// Returns "512,512", "512*512" and "512x512px" as "512x512"; other texts are unchanged.
std::string size_spelling(std::string text)
{
    std::string plain = lower_case(text);
    const std::size_t cross = plain.find("\u00d7");  // the multiplication sign
    if (cross != std::string::npos) {
        plain.replace(cross, std::string_view("\u00d7").size(), "x");
    }
    std::erase(plain, ' ');
    for (std::size_t unit = plain.find("px"); unit != std::string::npos; unit = plain.find("px")) {
        plain.erase(unit, 2);
    }
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == ',' || c == '*' || c == ':'; }, 'x');
    return parse_size(plain) ? plain : text;
}

template <typename Accept>
ValueType<double> number_that(const Accept& accept, std::string expected, Range range = {})
{
    const auto parse = [accept](const std::string& text) {
        const std::optional<double> value = parse_number<double>(text);
        return value && accept(*value) ? value : std::nullopt;
    };
    return {.parse = parse,
            .expected = std::move(expected),
            .info = {.json = JsonType::number, .range = range}};
}

/// Accepts three numbers in [0, most], or one for all channels.
ValueType<Rgb> color_up_to(float most, std::string expected)
{
    const auto parse = [most](const std::string& text) -> std::optional<Rgb> {
        const std::optional<float> grey = parse_float(text);
        const std::optional<Vec3> color = grey ? Vec3(*grey) : parse_vec3(text);
        for (int channel = 0; channel < 3; ++channel) {
            if (!color || !((*color)[channel] >= 0.0f && (*color)[channel] <= most)) {
                return std::nullopt;
            }
        }
        return *color;
    };
    return {.parse = parse, .expected = std::move(expected), .info = {.separator = ','}};
}

}  // namespace

ValueType<std::string> any_text()
{
    return {.parse = [](const std::string& text) { return std::optional(text); },
            .expected = "a text",
            .info = {}};
}

ValueType<std::string> file_path(std::vector<std::string> words)
{
    ValueType<std::string> type = any_text();
    type.info = {.words = std::move(words), .is_path = true};
    return type;
}

ValueType<std::string> some_text(std::string expected)
{
    const auto parse = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional(text);
    };
    return {.parse = parse, .expected = std::move(expected), .info = {}};
}

ValueType<std::string> file_named(std::vector<std::string> extensions, std::string expected)
{
    const auto parse = [extensions = std::move(extensions)](const std::string& text) {
        const bool good = std::any_of(extensions.begin(), extensions.end(),
                                      [&](const std::string& e) { return has_extension(text, e); });
        return good ? std::optional(text) : std::nullopt;
    };
    return {.parse = parse, .expected = std::move(expected), .info = {.is_path = true}};
}

ValueType<std::int64_t> whole_number(std::int64_t least, std::int64_t most)
{
    const auto parse = [least, most](const std::string& text) {
        const auto value = parse_number<std::int64_t>(text);
        return value && *value >= least && *value <= most ? value : std::nullopt;
    };
    return {.parse = parse,
            .expected = fmt::format("a whole number from {} to {}", least, most),
            .info = {.json = JsonType::whole_number,
                     .range = {static_cast<double>(least), static_cast<double>(most)},
                     .respelled = whole_spelling}};
}

ValueType<std::uint64_t> any_seed()
{
    return {.parse = parse_number<std::uint64_t>,
            .expected = "a whole number from 0 to 2^64 - 1",
            .info = {.json = JsonType::whole_number, .range = {.low = 0}}};
}

ValueType<std::uint64_t> memory_size()
{
    return parsed_by(parse_bytes, "a size like 500M or 2G");
}

ValueType<double> number(double least, double most)
{
    return number(least, most, fmt::format("a number from {} to {}", least, most));
}

ValueType<double> number(double least, double most, std::string expected)
{
    return number_within({least, most}, std::move(expected));
}

ValueType<double> number_above(double low, double most, std::string expected)
{
    return number_within({low, most, true}, std::move(expected));
}

ValueType<double> number_within(const Range& range, std::string expected)
{
    return number_that([range](double value) { return range.contains(value); }, std::move(expected),
                       range);
}

ValueType<double> finite_number(std::string expected)
{
    return number_that([](double value) { return std::isfinite(value); }, std::move(expected));
}

ValueType<double> positive_number(std::string expected)
{
    return number_that(
        [](double value) {
            return static_cast<float>(value) > 0.0f && std::isfinite(static_cast<float>(value));
        },
        std::move(expected));
}

ValueType<DVec3> point()
{
    const auto parse = [](const std::string& text) {
        // Single precision must be able to hold it, too.
        return parse_vec3(text) ? parse_numbers<DVec3>(text) : std::nullopt;
    };
    ValueType<DVec3> type = parsed_by(parse, "three numbers x,y,z");
    type.info.separator = ',';
    return type;
}

ValueType<double> duration(std::string expected)
{
    return parsed_by(parse_duration, std::move(expected));
}

ValueType<Size> image_size()
{
    ValueType<Size> type =
        parsed_by(parse_size, "WIDTHxHEIGHT from 1x1 to 65535x65535, or one number for both");
    type.info.separator = 'x';
    type.info.respelled = size_spelling;
    return type;
}

ValueType<double> noise_level()
{
    return parsed_by(parse_share, "a relative error above 0% and up to 100%, like 2%");
}

ValueType<SampleRange> sample_range()
{
    const auto parse = [](const std::string& text) {
        const std::optional<SampleSet> set = SampleSet::parse(text);
        return set && set->ranges().size() == 1 ? std::optional(set->ranges().front())
                                                : std::nullopt;
    };
    return {.parse = parse,
            .expected = "two whole numbers A:B with A below B, and below 2^32, like 64:128",
            .info = {}};
}

ValueType<double> percent(double most)
{
    return converted(
        number_above(0.0, most, fmt::format("a percentage above 0 and up to {:g}", most)),
        [](double value) { return value / 100.0; });
}

ValueType<Rgb> extinction()
{
    constexpr float most = 1e6f;  // [1/m]
    return color_up_to(most, "one or three numbers from 0 to 1000000 [1/m]");
}

ValueType<Rgb> albedo()
{
    return color_up_to(1.0f, "one or three numbers from 0 to 1");
}

ValueType<float> anisotropy()
{
    constexpr auto most = static_cast<double>(max_anisotropy);
    return converted(
        number(-most, most, fmt::format("a number from {:.4f} to {:.4f}", -most, most)),
        [](double value) { return static_cast<float>(value); });
}

std::string words_text(const std::vector<std::string>& words)
{
    const std::span<const std::string> all(words);
    const std::size_t others = all.size() > 1 ? all.size() - 1 : 0;
    return fmt::format("{}{}{}", fmt::join(all.first(others), ", "), others > 0 ? " or " : "",
                       all.back());
}

std::string choice_text(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, "|"));
}

}  // namespace bdpt::job
