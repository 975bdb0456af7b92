#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "parser/command_parser.h"

namespace bdpt::manual {

/// What a shell offers as the value of an option beside its words.
enum class Paths : std::uint8_t { none, files, folders };

/// A command of bdpt, as its help text tells of it.
struct CommandInfo {
    std::string name;  ///< "render"
    std::string text;  ///< what it does, in a line
    std::vector<job::Option> options;
    std::vector<job::Option> arguments;
    std::vector<std::string> footer;  ///< paragraphs after the options
};

/// Returns the names of an option: "-o", "--output"; of an argument its word, "file".
[[nodiscard]] std::vector<std::string> list_names(const job::Option& option);

/// Returns the words that the value of `option` may be.
[[nodiscard]] std::vector<std::string> list_choices(const job::Option& option);

[[nodiscard]] Paths find_paths(const job::Option& option);

/// The first sentence of `text`, without what is in brackets: a line of a menu.
[[nodiscard]] std::string extract_summary(const std::string& text);

/// The program itself: its name, its options, its footer.
[[nodiscard]] CommandInfo describe_program(const app::Program& program);

/// Its commands, in the order of the help text.
[[nodiscard]] std::vector<CommandInfo> describe_commands(const app::Program& program);

// Scripts that let a shell complete commands, options, their words and files.

/// Returns the file bash_completion.sh, with \@OPTIONS\@ and \@VALUES\@ in place of those.
[[nodiscard]] std::string_view bash_template();
[[nodiscard]] std::string bash_completion(std::span<const CommandInfo> commands);
[[nodiscard]] std::string zsh_completion(std::span<const CommandInfo> commands);
[[nodiscard]] std::string fish_completion(std::span<const CommandInfo> commands);

/// bdpt(1): the program and its commands, in the macros of man(7).
[[nodiscard]] std::string man_page(const CommandInfo& program,
                                   std::span<const CommandInfo> commands);

/// bdpt-render(1) and its like.
[[nodiscard]] std::string man_page(const CommandInfo& command);

}  // namespace bdpt::manual
