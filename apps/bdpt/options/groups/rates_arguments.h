#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say about adaptive sampling, as they were given.
struct RatesWords {
    bool adaptive = false;
    std::optional<std::string> file;
    std::optional<std::string> saved;
};

/// Where rates of samples come from, and where they go.
struct RatesChoice {
    std::optional<std::filesystem::path> file{};   ///< none: a pilot finds them
    std::optional<std::filesystem::path> saved{};  ///< .exr or .png
};

/// Describes --adaptive and --rates to the parser.
void add_rates_options(CLI::App& command, RatesWords& words, const char* group);

/// Describes --save-rates to the parser.
void add_save_rates_option(CLI::App& command, RatesWords& words, const char* group);

/// None without adaptive sampling. Throws `OptionError`.
[[nodiscard]] std::optional<RatesChoice> rates_choice(const RatesWords& words);

}  // namespace bdpt::app
