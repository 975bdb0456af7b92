#pragma once

#include <bdpt/options/enumerators.h>
#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "options/option_list.h"

namespace bdpt::job {

// Parsers of texts.

/// Size of an image [pixels].
struct Size {
    int width = 0;
    int height = 0;
};

/// Converts ASCII letters to lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Tests whether `value` is one of `values`.
template <typename Values, typename Value>
[[nodiscard]] bool is_among(const Values& values, const Value& value)
{
    return std::find(std::begin(values), std::end(values), value) != std::end(values);
}

/// Splits `text` at each `separator`; parts may be empty.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Parses all of `text` as one number in decimal digits, which may be infinite.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// Parses "1280x720", or "512" for a square; both at least 1 and at most 65535.
[[nodiscard]] std::optional<Size> parse_size(std::string_view text);

/// Parses "90", "90s", "2m", "1.5h" or "1h30m", as seconds; more than 0.
[[nodiscard]] std::optional<double> parse_duration(std::string_view text);

/// Parses "1500000", "800K", "500M" or "2.5G", as bytes, by powers of 1024; at least 1 and below
/// 2^63.
[[nodiscard]] std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// Parses "2%", "2" or "0.02" as a fraction: numbers from 1 are percent, too. Above 0 and at most
/// 1.
[[nodiscard]] std::optional<double> parse_share(std::string_view text);

/// Parses "x,y,z", all finite.
[[nodiscard]] std::optional<Vec3> parse_vec3(std::string_view text);

/// Parses a finite number.
[[nodiscard]] std::optional<float> parse_float(std::string_view text);

/// Parses a finite number in double precision.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// Parses an index: digits only.
[[nodiscard]] std::optional<std::size_t> parse_index(std::string_view text);

/// Network address.
struct NetworkAddress {
    std::string host;
    std::string port;
    [[nodiscard]] bool operator==(const NetworkAddress&) const = default;
};

/// Parses "HOST", "HOST:PORT", ":PORT" (this machine) or "[IPV6]:PORT". The default port is that of
/// the viewer tev; if it is "0", any free one, 0 is a port, too.
[[nodiscard]] std::optional<NetworkAddress> parse_address(
    const std::string& text, const std::string& default_port = "14158");

/// Parses values separated by commas; each once.
template <typename Value>
[[nodiscard]] std::optional<std::vector<Value>> parse_each_once(
    const std::string& text, std::optional<Value> (*parse)(std::string_view part))
{
    std::vector<Value> result;
    for (const std::string_view part : split(text, ',')) {
        const std::optional<Value> value = parse(part);
        if (!value) {
            return std::nullopt;
        }
        if (!is_among(result, *value)) {
            result.push_back(*value);
        }
    }
    return result;
}

// Conversions of option texts to values (`ValueType`).

/// Accepts any text, also an empty one.
[[nodiscard]] ValueType<std::string> any_text();

/// Accepts the path of a file or folder, or one of `words`.
[[nodiscard]] ValueType<std::string> file_path(std::vector<std::string> words = {});

/// Accepts a text that is not empty; `expected` describes it.
[[nodiscard]] ValueType<std::string> some_text(std::string expected);

/// Accepts the name of a file that ends with one of `extensions`, such as ".exr".
[[nodiscard]] ValueType<std::string> file_named(std::vector<std::string> extensions,
                                                std::string expected);

/// Accepts digits with an optional sign, in [least, most].
[[nodiscard]] ValueType<std::int64_t> whole_number(std::int64_t least, std::int64_t most);

/// Accepts 0 to 2^64 - 1.
[[nodiscard]] ValueType<std::uint64_t> any_seed();

/// Accepts "a size like 500M or 2G" of memory, as bytes.
[[nodiscard]] ValueType<std::uint64_t> memory_size();

/// Accepts a decimal number in [least, most].
[[nodiscard]] ValueType<double> number(double least, double most);

/// Accepts a decimal number in [least, most]; `expected` says so, with its unit.
[[nodiscard]] ValueType<double> number(double least, double most, std::string expected);

/// Accepts a decimal number in (low, most]; `expected` says so.
[[nodiscard]] ValueType<double> number_above(double low, double most, std::string expected);

/// Accepts a decimal number in `range`; `expected` says so.
[[nodiscard]] ValueType<double> number_within(const Range& range, std::string expected);

/// Accepts a finite number.
[[nodiscard]] ValueType<double> finite_number(std::string expected = "a number");

/// Accepts a number above 0 that is finite as a float, too; `expected` says so, with its unit.
[[nodiscard]] ValueType<double> positive_number(std::string expected);

/// Accepts texts that `parse` can parse.
template <typename Parse>
[[nodiscard]] auto parsed_by(Parse parse, std::string expected)
    -> ValueType<typename decltype(parse(std::declval<const std::string&>()))::value_type>
{
    return {.parse = std::move(parse), .expected = std::move(expected), .info = {}};
}

/// Returns `type` with its values converted.
template <typename Value, typename Convert>
[[nodiscard]] auto converted(ValueType<Value> type, Convert convert)
    -> ValueType<decltype(convert(std::declval<Value>()))>
{
    const auto parse = [parse = std::move(type.parse), convert](const std::string& text) {
        const std::optional<Value> value = parse(text);
        return value ? std::optional(convert(*value)) : std::nullopt;
    };
    return {.parse = parse, .expected = std::move(type.expected), .info = std::move(type.info)};
}

/// Accepts "three numbers x,y,z".
[[nodiscard]] ValueType<DVec3> point();

/// Accepts "a time like 60s, 2m or 1h30m", as seconds.
[[nodiscard]] ValueType<double> duration(std::string expected = "a time like 60s, 2m or 1h30m");

/// Accepts "WIDTHxHEIGHT", or one number for both.
[[nodiscard]] ValueType<Size> image_size();

/// Accepts "2%", "2" or "0.02" as a fraction.
[[nodiscard]] ValueType<double> noise_level();

/// Accepts "A:B": samples A to B - 1.
[[nodiscard]] ValueType<SampleRange> sample_range();

/// Accepts percent in (0, most] as a fraction.
[[nodiscard]] ValueType<double> percent(double most);

/// Accepts the extinction of a medium [1/m]: a number from 0 to 10^6, or three.
[[nodiscard]] ValueType<Rgb> extinction();

/// Accepts a single-scattering albedo: a number in [0, 1], or three.
[[nodiscard]] ValueType<Rgb> albedo();

/// Accepts g of Henyey and Greenstein's phase function.
[[nodiscard]] ValueType<float> anisotropy();

/// Returns "pt, nee or mis".
[[nodiscard]] std::string words_text(const std::vector<std::string>& words);

/// Returns "pt|nee|mis".
[[nodiscard]] std::string choice_text(const std::vector<std::string>& words);

/// A set of words, each of which stands for a value.
template <typename Value>
struct Choices {
    std::vector<std::pair<std::string, Value>> entries;

    [[nodiscard]] std::vector<std::string> words() const
    {
        std::vector<std::string> words;
        for (const auto& [word, value] : entries) {
            words.push_back(word);
        }
        return words;
    }
    [[nodiscard]] ValueType<Value> type() const
    {
        const auto parse = [entries = entries](const std::string& text) -> std::optional<Value> {
            for (const auto& [word, value] : entries) {
                if (word == text) {
                    return value;
                }
            }
            return std::nullopt;
        };
        return {.parse = parse, .expected = words_text(words()), .info = {.words = words()}};
    }
};

/// Accepts the "true" and "false" of a flag.
template <typename Value>
[[nodiscard]] ValueType<Value> on_or_off(Value on, Value off)
{
    return Choices<Value>{{{"true", on}, {"false", off}}}.type();
}

/// Adds an option whose value is one of `choices`.
template <typename Target, typename Value>
Option& add_choice(OptionList& options, std::string names, std::string help, Target& target,
                   const Choices<Value>& choices)
{
    return options.add(std::move(names), choice_text(choices.words()), std::move(help), target,
                       choices.type());
}

/// Returns the words of an enumeration.
template <HasEnumerators Enum>
[[nodiscard]] Choices<Enum> choices_of_enumeration()
{
    Choices<Enum> result;
    for (const auto& [value, name] : enumerators<Enum>) {
        result.entries.emplace_back(std::string(name), value);
    }
    return result;
}

/// Returns the words of all `values`, by their names.
template <typename Values, typename GetName>
[[nodiscard]] auto make_choices(const Values& values, const GetName& get_name)
{
    Choices<std::remove_cvref_t<decltype(*std::begin(values))>> result;
    for (const auto value : values) {
        result.entries.emplace_back(std::string(get_name(value)), value);
    }
    return result;
}

}  // namespace bdpt::job
