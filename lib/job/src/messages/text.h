#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bdpt::job {

/// Returns `text` without line breaks and control characters that a terminal would obey, and with
/// invalid UTF-8 replaced.
[[nodiscard]] std::string one_line(std::string_view text);

/// Escapes such characters in `text` of several lines, or in JSON, as JSON does: "\u009b".
[[nodiscard]] std::string escaped(std::string_view text);

/// Returns "1 light", "2 lights": `noun` has a plural in s.
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

/// Quotes `word` for a shell.
[[nodiscard]] std::string shell_word(const std::string& word);

/// Wraps the words of `text` to lines of up to `columns`.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t columns);

/// Wraps the paragraphs of `text` that are wider; lines that begin with a space are kept.
[[nodiscard]] std::string wrapped_paragraphs(std::string_view text, std::size_t columns);

/// Formats seconds as "1:07" or "2:03:09".
[[nodiscard]] std::string clock_time(double seconds);

}  // namespace bdpt::job
