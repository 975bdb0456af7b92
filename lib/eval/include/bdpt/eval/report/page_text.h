#pragma once

/// @file
/// Fills pages of HTML with texts and numbers.
///
/// @code{.cpp}
/// const std::string data = bdpt::eval::script_safe(R"({"scene": "room"})");
/// const std::string page =
///     bdpt::eval::fill_page("<script>show({{DATA}}, '{{HEAT}}')</script>",
///                           {{"DATA", data}, {"HEAT", bdpt::eval::heat_text()}});
/// @endcode

#include <bdpt/export.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Building blocks of HTML pages. Their parts that show images, colours and numbers are shared:
// lib/eval/src/report/page.

namespace bdpt::eval {

/// Returns the colours of the heat map from 0 to 1, six hexadecimal digits each.
[[nodiscard]] BDPT_EXPORT std::string heat_text();

/// Escapes JSON so that no HTML parser finds the end of a script in it.
[[nodiscard]] BDPT_EXPORT std::string script_safe(std::string_view json);

/// Replaces each word in double braces in `text` by its value.
[[nodiscard]] BDPT_EXPORT std::string fill_page(
    std::string_view text,
    const std::vector<std::pair<std::string_view, std::string_view>>& values);

}  // namespace bdpt::eval
