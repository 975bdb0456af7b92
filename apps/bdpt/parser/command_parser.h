#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"
#include "terminal/console.h"

namespace bdpt::app {

/// An option that the short help of a command shows.
struct Essential {
    std::string_view name;
    std::string_view brief{};  ///< in place of what the option says it does; empty: that
};

/// A command of the program.
struct Command {
    std::string name;     ///< "render"
    std::string summary;  ///< one line
    std::string footer;   ///< printed below the options in its help: examples, exit codes
    OptionList options;
    /// Runs it with the options as stored; the words are the whole command line. Returns the exit
    /// code.
    std::function<int(const std::vector<std::string>& words)> run{};
    /// The options that its help shows, in one section; --help-all shows all. Empty: all.
    std::vector<Essential> essentials{};
    std::string short_footer{};  ///< in place of `footer`, below the essentials
};

/// The words of a command line.
using Words = std::vector<std::string>;

/// Level of detail of a help text.
enum class HelpDetail : std::uint8_t { essentials, all };

/// A program: a set of commands.
struct Program {
    std::string name;
    std::string summary;
    std::string footer;
    std::function<std::string()> version;  ///< text of --version
    std::deque<Command> commands;

    /// Returns the command of that name, or null.
    [[nodiscard]] const Command* find(std::string_view name) const;
};

/// Adds a command. `add_options(options, request)` adds its options, which store into a `Request`;
/// `run(request, options, words)` runs it.
template <typename Request, typename AddOptions, typename Run>
Command& add_command(Program& program, const char* name, const char* summary, const char* footer,
                     const AddOptions& add_options, const Run& run)
{
    Command& command = program.commands.emplace_back();
    command.name = name;
    command.summary = summary;
    command.footer = footer;
    const auto request = std::make_shared<Request>();
    add_options(command.options, *request);
    command.run = [&command, request, run](const Words& words) {
        return run(*request, command.options, words);
    };
    return command;
}

/// Returns how to run a command by its checked arguments alone.
template <typename Arguments>
[[nodiscard]] auto checked_by(int (*run)(const Arguments& arguments))
{
    return [run](const auto& request, const OptionList& options, const Words& /*words*/) {
        return run(checked(request, options));
    };
}

/// Result of parsing a command line.
struct ParsedLine {
    Command* command = nullptr;         ///< the command whose options have been stored
    std::optional<std::string> text{};  ///< text of --help or --version, which replaces the command
};

/// Parses the command line `words`, without the name of the program, and stores it into the options
/// of the command that it names. Throws `Error` (usage), whose message says where help is.
[[nodiscard]] ParsedLine parse(Program& program, const std::vector<std::string>& words);

/// Parses `words` of one command and stores them into `options`. Throws `OptionError`.
void parse(OptionList& options, const std::vector<std::string>& words);

/// Returns the text of --help, for the program or for one command; or that of --help-all.
[[nodiscard]] std::string help_text(Program& program, std::string_view command = "",
                                    HelpDetail detail = HelpDetail::essentials);

/// Returns "unknown command ...: expected ...".
[[nodiscard]] std::string unknown_command(const Program& program, const std::string& word,
                                          const std::string& help);

/// Returns what to type in place of `word`, an option that a command with these `options` does not
/// have but other renderers and image tools do: "use --size WxH" for "--width". None: not known.
[[nodiscard]] std::optional<std::string> advice_for_option(std::string_view word,
                                                           const OptionList& options);

/// Returns the command of ours for the `word` of another program, "compare" for "diff"; none: not
/// known.
[[nodiscard]] std::optional<std::string_view> command_for(std::string_view word);

/// Throws `OptionError` if `words`, the options of a command as typed, contain a long option with a
/// single dash, like "-output" or "-resize": the parser would take its letters for short options.
void check_dashes(const std::vector<std::string>& words, const OptionList& options);

/// Throws `OptionError` if `word`, one of several scenes, is clearly something else: an image,
/// where outputs are not named, a number, or NAME=VALUE.
void check_scene_word(const std::string& word, const OptionList& options);

}  // namespace bdpt::app
