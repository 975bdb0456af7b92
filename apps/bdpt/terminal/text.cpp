#include "terminal/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace bdpt::app {

std::string one_line(std::string_view text)
{
    // The JSON library knows UTF-8; its text is safe to print when it is read back.
    using nlohmann::json;
    const std::string utf8 =
        json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
            .get<std::string>();
    std::string result;
    for (const char c : utf8) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        result += control ? ' ' : c;
    }
    return result;
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
    // A week and more is shown as that; also keeps infinity out of the conversion.
    constexpr double longest = 7.0 * 24.0 * 3600.0;
    const auto total = static_cast<std::int64_t>(std::clamp(seconds, 0.0, longest) + 0.5);
    const std::int64_t hours = total / 3600;
    const std::int64_t minutes = total / 60 % 60;
    if (hours > 0) {
        return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
    }
    return fmt::format("{}:{:02}", minutes, total % 60);
}

}  // namespace bdpt::app
