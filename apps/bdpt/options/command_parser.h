#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

/// A command of the program.
struct Command {
    std::string name;     ///< "render"
    std::string summary;  ///< what it does, in a line
    std::string footer;   ///< below the options in its help: examples, exit codes
    OptionList options;
    /// Names of the options that its help shows; --help-all shows the others, too. Empty: all.
    std::vector<std::string_view> essentials{};
    std::string short_footer{};  ///< in place of `footer`, below the essentials
};

/// How much of a command a help text shows.
enum class HelpDetail : std::uint8_t { essentials, all };

/// A program that is a set of commands.
struct Program {
    std::string name;
    std::string summary;
    std::string footer;
    std::function<std::string()> version;  ///< text of --version
    std::deque<Command> commands;

    /// Null: there is none of that name.
    [[nodiscard]] const Command* find(std::string_view name) const;
};

/// What a command line asks for.
struct ParsedLine {
    Command* command = nullptr;         ///< whose options have been stored
    std::optional<std::string> text{};  ///< of --help or --version, in place of the command
};

/// The command line `words` without the name of the program, stored into the options of the command
/// that they name. Throws `Error` (usage), whose message says where help is.
[[nodiscard]] ParsedLine parse(Program& program, const std::vector<std::string>& words);

/// `words` of one command, stored into `options`. Throws `OptionError`.
void parse(OptionList& options, const std::vector<std::string>& words);

/// The text of --help, of the program or of one command; or that of --help-all.
[[nodiscard]] std::string help_text(Program& program, std::string_view command = "",
                                    HelpDetail detail = HelpDetail::essentials);

/// "unknown command ...: expected ...".
[[nodiscard]] std::string unknown_command(const Program& program, const std::string& word,
                                          const std::string& help);

}  // namespace bdpt::app
