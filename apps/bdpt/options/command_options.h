#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace bdpt::app {

/// Of an option that takes one value, the last one counts if it is given more than once.
void let_the_last_count(CLI::App& command);

/// `words` as CLI11 takes them, from the end. "--name=" becomes "--name" and an empty word: CLI11
/// would take the next word for its value.
[[nodiscard]] std::vector<std::string> words_for_parser(std::span<const std::string> words);

/// The options of one group of the help text that were given to `command`, each as one word that
/// says the same: "--spp=64", "--half". Those that take several values are left out.
[[nodiscard]] std::vector<std::string> given_options(const CLI::App& command,
                                                     std::string_view group);

/// The names, as "--spp", of the same options of the group, whether they were given or not.
[[nodiscard]] std::vector<std::string> option_names(const CLI::App& command,
                                                    std::string_view group);

}  // namespace bdpt::app
