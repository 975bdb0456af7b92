#include "messages/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>

namespace bdpt::job {
namespace {

struct CodeRange {
    char32_t first;
    char32_t last;
};

/// Characters that are obeyed instead of shown: control characters, and those of Unicode that break
/// lines, change the direction of text or are invisible. The joiners U+200C and U+200D belong to
/// letters.
constexpr std::array<CodeRange, 11> unprintable{{{0x00, 0x1f},
                                                 {0x7f, 0x9f},
                                                 {0x61c, 0x61c},
                                                 {0x200b, 0x200b},
                                                 {0x200e, 0x200f},
                                                 {0x2028, 0x202e},
                                                 {0x2060, 0x206f},
                                                 {0xfeff, 0xfeff},
                                                 {0xfff9, 0xfffb},
                                                 {0xe0000, 0xe007f},
                                                 {0xd800, 0xdfff}}};

bool is_printable(char32_t code)
{
    return std::none_of(unprintable.begin(), unprintable.end(), [code](const CodeRange& range) {
        return range.first <= code && code <= range.last;
    });
}

std::string valid_utf8(std::string_view text)
{
    // The JSON library validates UTF-8; its output can be decoded safely.
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
        .get<std::string>();
}

/// Returns the number of bytes of the UTF-8 character that begins with `lead`.
std::size_t count_bytes(unsigned char lead)
{
    return lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
}

/// Decodes the single character in `bytes`.
char32_t decode_character(std::string_view bytes)
{
    constexpr std::array<unsigned char, 5> lead_bits{0, 0x7f, 0x1f, 0x0f, 0x07};
    char32_t code = static_cast<unsigned char>(bytes[0]) & lead_bits.at(bytes.size());
    for (const char c : bytes.substr(1)) {
        code = code << 6U | (static_cast<unsigned char>(c) & 0x3fU);
    }
    return code;
}

/// Replaces each unprintable character of `text`, UTF-8, by `replacement`.
template <typename Replacement>
std::string with_replaced(std::string_view text, const Replacement& replacement)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view bytes =
            text.substr(i, count_bytes(static_cast<unsigned char>(text[i])));
        const char32_t code = decode_character(bytes);
        result += is_printable(code) ? std::string(bytes) : replacement(code);
        i += bytes.size();
    }
    return result;
}

}  // namespace

std::string one_line(std::string_view text)
{
    return with_replaced(valid_utf8(text), [](char32_t) { return std::string(" "); });
}

std::string escaped(std::string_view text)
{
    return with_replaced(valid_utf8(text), [](char32_t code) {
        // JSON writes characters from here on as two surrogates.
        constexpr char32_t pairs = 0x10000;
        if (code == U'\n' || code == U'\t') {
            return std::string(1, static_cast<char>(code));
        }
        if (code < pairs) {
            return fmt::format("\\u{:04x}", std::uint32_t{code});
        }
        const std::uint32_t rest = code - pairs;
        return fmt::format("\\u{:04x}\\u{:04x}", 0xd800U + (rest >> 10U),
                           0xdc00U + (rest & 0x3ffU));
    });
}

std::string counted(std::size_t count, std::string_view noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string shell_word(const std::string& word)
{
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_./:,=+@%-").find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain) {
        return word;
    }
    std::string result = "'";
    for (const char c : word) {
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return result + "'";
}

std::string clock_time(double seconds)
{
    // Longer times are shown as a week; also excludes infinity from the conversion.
    constexpr double longest = 7.0 * 24.0 * 3600.0;
    const auto total = static_cast<std::int64_t>(std::clamp(seconds, 0.0, longest) + 0.5);
    const std::int64_t hours = total / 3600;
    const std::int64_t minutes = total / 60 % 60;
    if (hours > 0) {
        return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
    }
    return fmt::format("{}:{:02}", minutes, total % 60);
}

std::string wrapped(std::string_view text, std::size_t columns)
{
    std::istringstream words{std::string(text)};
    std::string result;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        const bool wraps = column > 0 && column + 1 + word.size() > columns;
        column = wraps ? word.size() : column + word.size() + (column > 0 ? 1 : 0);
        result += result.empty() ? "" : wraps ? "\n" : " ";
        result += word;
    }
    return result;
}

std::string wrapped_paragraphs(std::string_view text, std::size_t columns)
{
    std::istringstream lines{std::string(text)};
    std::string result;
    std::string paragraph;
    const auto end_paragraph = [&] {
        result += paragraph.empty() ? "" : wrapped(paragraph, columns) + "\n";
        paragraph.clear();
    };
    for (std::string line; std::getline(lines, line);) {
        // A title above an example is kept on its own line.
        const bool is_fixed = line.empty() || line.front() == ' ';
        if (is_fixed) {
            end_paragraph();
            result += line + "\n";
        } else {
            paragraph += line + " ";
        }
    }
    end_paragraph();
    return result;
}

}  // namespace bdpt::job
