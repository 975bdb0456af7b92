#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bdpt::app {

/// `text` with @NAME@ replaced by its value.
[[nodiscard]] std::string filled(const std::string& text,
                                 const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace bdpt::app
