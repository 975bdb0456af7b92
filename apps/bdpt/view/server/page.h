#pragma once

#include <string>
#include <string_view>

namespace bdpt::app {

/// The page of `bdpt view`, which needs nothing else.
[[nodiscard]] std::string view_page();

// What it is made of: files of apps/bdpt/view/page, and those that the report of bdpt bench shares.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::app
