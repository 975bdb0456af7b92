#include "options/value_types.h"

#include <bdpt/medium_desc.h>
#include <bdpt/part/sample_set.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "options/output_files.h"

namespace bdpt::app {
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
    return number_that([=](double value) { return value >= least && value <= most; },
                       std::move(expected), {least, most});
}

ValueType<double> number_above(double low, double most, std::string expected)
{
    return number_that([=](double value) { return value > low && value <= most; },
                       std::move(expected), {low, most, true});
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
    ValueType<DVec3> type = parsed_by(parse_dvec3, "three numbers x,y,z");
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

}  // namespace bdpt::app
