#pragma once

#include <bdpt/options/enumerators.h>
#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "options/arguments.h"
#include "options/option_list.h"

namespace bdpt::app {

// How the texts of options become values (`ValueType`).

/// Any text, also an empty one.
[[nodiscard]] ValueType<std::string> any_text();

/// The path of a file or folder, or one of `words`.
[[nodiscard]] ValueType<std::string> file_path(std::vector<std::string> words = {});

/// A text that is not empty; `expected` says what it is.
[[nodiscard]] ValueType<std::string> some_text(std::string expected);

/// The name of a file that ends with one of `extensions`, as ".exr".
[[nodiscard]] ValueType<std::string> file_named(std::vector<std::string> extensions,
                                                std::string expected);

/// Digits, and a sign, in [least, most].
[[nodiscard]] ValueType<std::int64_t> whole_number(std::int64_t least, std::int64_t most);

/// All of `text` as a decimal number, also an infinite one.
[[nodiscard]] std::optional<double> decimal_number(const std::string& text);

/// From 0 to 2^64 - 1.
[[nodiscard]] ValueType<std::uint64_t> any_seed();

/// A decimal number in [least, most].
[[nodiscard]] ValueType<double> number(double least, double most);

/// A decimal number in [least, most]; `expected` says so, with its unit.
[[nodiscard]] ValueType<double> number(double least, double most, std::string expected);

/// A decimal number in (low, most]; `expected` says so.
[[nodiscard]] ValueType<double> number_above(double low, double most, std::string expected);

/// A finite number.
[[nodiscard]] ValueType<double> finite_number(std::string expected = "a number");

/// A number above 0, also as a float, where it is finite; `expected` says so, with its unit.
[[nodiscard]] ValueType<double> positive_number(std::string expected);

/// What `parse` makes of a text.
template <typename Parse>
[[nodiscard]] auto parsed_by(Parse parse, std::string expected)
    -> ValueType<typename decltype(parse(std::declval<const std::string&>()))::value_type>
{
    return {.parse = std::move(parse), .expected = std::move(expected), .info = {}};
}

/// "three numbers x,y,z".
[[nodiscard]] ValueType<Vec3> point();

/// "a time like 60s, 2m or 1h30m", as seconds.
[[nodiscard]] ValueType<double> duration(std::string expected = "a time like 60s, 2m or 1h30m");

/// "WIDTHxHEIGHT", or one number for both.
[[nodiscard]] ValueType<Size> image_size();

/// "2%", "2" or "0.02" as a fraction.
[[nodiscard]] ValueType<double> noise_level();

/// "A:B": samples A to B - 1.
[[nodiscard]] ValueType<SampleRange> sample_range();

/// Percent in (0, most] as a fraction.
[[nodiscard]] ValueType<double> percent(double most);

/// Extinction of a medium [1/m]: a number from 0 to 10^6, or three.
[[nodiscard]] ValueType<Rgb> extinction();

/// Single-scattering albedo: a number in [0, 1], or three.
[[nodiscard]] ValueType<Rgb> albedo();

/// g of Henyey and Greenstein's phase function.
[[nodiscard]] ValueType<float> anisotropy();

/// "pt, nee or mis".
[[nodiscard]] std::string words_text(const std::vector<std::string>& words);

/// "pt|nee|mis".
[[nodiscard]] std::string choice_text(const std::vector<std::string>& words);

/// One of some words; each stands for a value.
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
    /// The first word of `value`, which is one of them.
    [[nodiscard]] std::string word_of(Value value) const
    {
        for (const auto& [word, its] : entries) {
            if (its == value) {
                return word;
            }
        }
        return {};
    }
};

/// The words of an enumeration.
template <HasEnumerators Enum>
[[nodiscard]] Choices<Enum> choices_of_enumeration()
{
    Choices<Enum> result;
    for (const auto& [value, name] : enumerators<Enum>) {
        result.entries.emplace_back(std::string(name), value);
    }
    return result;
}

/// Words for all of `values`, by their names.
template <typename Values, typename NameOf>
[[nodiscard]] auto choices_of(const Values& values, const NameOf& name_of)
{
    Choices<std::remove_cvref_t<decltype(*std::begin(values))>> result;
    for (const auto value : values) {
        result.entries.emplace_back(std::string(name_of(value)), value);
    }
    return result;
}

}  // namespace bdpt::app
