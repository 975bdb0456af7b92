#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::app {

/// A check for the parser: digits only, and in the range.
[[nodiscard]] CLI::Validator whole_number(std::int64_t least, std::int64_t most);

/// A check for the parser: a decimal number in the range.
[[nodiscard]] CLI::Validator number(double least, double most);

/// A check for the parser: one of these words.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

}  // namespace bdpt::app
