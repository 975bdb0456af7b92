#pragma once

#include <string>
#include <string_view>

namespace bdpt::app {

/// Returns the self-contained page of `bdpt view`.
[[nodiscard]] std::string view_page();

// Parts of the page: files of apps/bdpt/view/page, and those shared with the report of bdpt bench.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::app
