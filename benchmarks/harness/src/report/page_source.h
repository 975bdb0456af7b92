#pragma once

#include <string_view>

namespace bdpt::harness {

/// The files of benchmarks/harness/report/, as they were when the library was built.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::harness
