#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bdpt::app {

/// Replaces @NAME@ in `text` by its value.
[[nodiscard]] std::string filled(const std::string& text,
                                 const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace bdpt::app
