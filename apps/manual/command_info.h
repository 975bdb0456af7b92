#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "options/command_parser.h"

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

}  // namespace bdpt::manual
