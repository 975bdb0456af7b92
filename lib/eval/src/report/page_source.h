#pragma once

#include <string_view>

namespace bdpt::eval {

/// Contents of the files of lib/eval/src/report/page/ at build time.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::eval
