#pragma once

#include <bdpt/pixel_rect.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace bdpt::app {

/// `text` without line breaks and whatever else a terminal would obey in place of showing it, and
/// with what is not UTF-8 replaced.
[[nodiscard]] std::string one_line(std::string_view text);

/// `text` of several lines, or JSON, with the same written as JSON does, like "\u009b".
[[nodiscard]] std::string escaped(std::string_view text);

/// "1 light", "2 lights": `noun` has a plural in s.
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

/// `word` as a shell reads it back.
[[nodiscard]] std::string shell_word(const std::string& word);

/// "x0,y0,x1,y1"
[[nodiscard]] std::string rect_text(const PixelRect& rect);

/// The words of `text` in lines of up to `columns`.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns);

/// Paragraphs of `text` that are wider, wrapped; lines that begin with a space stay as they are.
[[nodiscard]] std::string wrapped_paragraphs(std::string_view text, std::size_t columns);

/// Seconds as "1:07" or "2:03:09".
[[nodiscard]] std::string clock_time(double seconds);

}  // namespace bdpt::app
