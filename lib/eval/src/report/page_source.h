#pragma once

#include <string_view>

namespace bdpt::eval {

/// The files of lib/eval/src/report/page/, as they were when the library was built.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::eval
