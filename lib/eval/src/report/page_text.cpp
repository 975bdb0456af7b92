#include <bdpt/eval/drawing.h>
#include <bdpt/eval/page.h>

#include <cstddef>
#include <cstdint>

namespace bdpt::eval {

std::string heat_text()
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    for (const Color8& color : heat_colors()) {
        for (const std::uint8_t channel : color) {
            result += digits[channel >> 4];
            result += digits[channel & 15];
        }
    }
    return result;
}

std::string script_safe(std::string_view json)
{
    std::string result;
    for (const char c : json) {
        result += c == '<' ? "\\u003c" : std::string(1, c);
    }
    return result;
}

std::string fill_page(std::string_view text,
                      const std::vector<std::pair<std::string_view, std::string_view>>& values)
{
    std::string result;
    while (true) {
        const std::size_t open = text.find("{{");
        const std::size_t close = text.find("}}", open);
        if (close == std::string_view::npos) {
            return result.append(text);
        }
        result.append(text.substr(0, open));
        const std::string_view word = text.substr(open + 2, close - open - 2);
        for (const auto& [name, value] : values) {
            if (name == word) {
                result.append(value);
            }
        }
        text.remove_prefix(close + 2);
    }
}

}  // namespace bdpt::eval
