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

/// An option of a command, or an argument without a name before it.
struct OptionInfo {
    std::vector<std::string> names;  ///< "-o", "--output"; of an argument its word, "file"
    std::string value;               ///< "FILE"; empty: a flag
    bool value_may_be_left_out = false;
    bool repeats = false;
    std::string text;                  ///< what it does
    std::string group;                 ///< title in the help text; empty for arguments
    std::vector<std::string> choices;  ///< words that the value may be
    Paths paths = Paths::none;
};

/// A command of bdpt, as its help text tells of it.
struct CommandInfo {
    std::string name;  ///< "render"
    std::string text;  ///< what it does, in a line
    std::vector<OptionInfo> options;
    std::vector<OptionInfo> arguments;
    std::vector<std::string> footer;  ///< paragraphs after the options
};

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
