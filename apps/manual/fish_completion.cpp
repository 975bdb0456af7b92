#include <fmt/core.h>
#include <fmt/format.h>

#include "completions.h"

namespace bdpt::manual {
namespace {

std::string fish_quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return result + "'";
}

std::string option_line(const CommandInfo& command, const OptionInfo& option)
{
    std::string line =
        fmt::format("complete -c bdpt -n '__fish_seen_subcommand_from {}'", command.name);
    for (const std::string& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    // -x: a value, and no files; -r -F: a value, and files too.
    if (!option.value.empty()) {
        line += option.paths == Paths::files     ? " -r -F"
                : option.paths == Paths::folders ? " -x"
                : option.value_may_be_left_out   ? ""
                                                 : " -x";
    }
    std::string words = fmt::format("{}", fmt::join(option.choices, " "));
    words += option.paths == Paths::folders ? "(__fish_complete_directories)" : "";
    if (!words.empty()) {
        line += " -a " + fish_quoted(words);
    }
    return line + " -d " + fish_quoted(extract_summary(option.text)) + "\n";
}

}  // namespace

std::string fish_completion(std::span<const CommandInfo> commands)
{
    std::string result =
        "# Completion of bdpt in fish; made from the options of the command.\n\n"
        "complete -c bdpt -f\n";
    for (const CommandInfo& command : commands) {
        result += fmt::format("complete -c bdpt -n __fish_use_subcommand -a {} -d {}\n",
                              command.name, fish_quoted(command.text));
    }
    for (const CommandInfo& command : commands) {
        for (const OptionInfo& option : command.options) {
            result += option_line(command, option);
        }
        for (const OptionInfo& argument : command.arguments) {
            result += fmt::format("complete -c bdpt -n '__fish_seen_subcommand_from {}'{}{}\n",
                                  command.name, argument.paths == Paths::files ? " -F" : "",
                                  argument.choices.empty()
                                      ? ""
                                      : fmt::format(" -a '{}'", fmt::join(argument.choices, " ")));
        }
    }
    return result;
}

}  // namespace bdpt::manual
