#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace bdpt::app {

/// A check for the parser: digits only, and in the range.
[[nodiscard]] CLI::Validator whole_number(std::int64_t least, std::int64_t most);

/// A check for the parser: a decimal number in the range.
[[nodiscard]] CLI::Validator number(double least, double most);

}  // namespace bdpt::app
