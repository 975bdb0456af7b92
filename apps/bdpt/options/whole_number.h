#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace bdpt::app {

/// A check for the parser: digits only, and in the range.
[[nodiscard]] CLI::Validator whole_number(std::int64_t least, std::int64_t most);

}  // namespace bdpt::app
