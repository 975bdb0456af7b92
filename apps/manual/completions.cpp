#include "manual.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace bdpt::manual {
namespace {

/// A line of _bdpt_values; empty for flags.
std::string values(const CommandInfo& command, const OptionInfo& option)
{
    if (option.value.empty()) {
        return "";
    }
    std::string words = fmt::format("{}", fmt::join(option.choices, " "));
    words += option.paths == Paths::files     ? " @files"
             : option.paths == Paths::folders ? " @folders"
                                              : "";
    std::string patterns;
    for (const std::string& name : option.names) {
        patterns += fmt::format("{}{}:{}", patterns.empty() ? "" : "|", command.name,
                                option.group.empty() ? "" : name);
    }
    return fmt::format("    {}) echo \"{}\" ;;\n", patterns, words);
}

}  // namespace

std::string bash_completion(std::span<const CommandInfo> commands)
{
    std::string names;
    std::string options;
    std::string words;
    for (const CommandInfo& command : commands) {
        names += (names.empty() ? "" : " ") + command.name;
        std::string own;
        for (const OptionInfo& option : command.options) {
            own += (own.empty() ? "" : " ") + option.names.back();
            words += values(command, option);
        }
        for (const OptionInfo& argument : command.arguments) {
            words += values(command, argument);
        }
        options += fmt::format("    {}) echo \"{}\" ;;\n", command.name, own);
    }
    options += fmt::format("    \"\") echo \"{}\" ;;\n", names);
    std::string result(bash_template());
    for (const auto& [mark, text] : {std::pair("@OPTIONS@\n", options), {"@VALUES@\n", words}}) {
        result.replace(result.find(mark), std::string_view(mark).size(), text);
    }
    return result;
}

namespace {

/// What stands in single quotes and brackets of _arguments.
std::string zsh_quoted(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\'') {
            result += "'\\''";
        } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
            result += std::string("\\") + c;
        } else {
            result += c;
        }
    }
    return result;
}

/// "message:action" of a value.
std::string action(const OptionInfo& option)
{
    std::string words;
    if (option.paths != Paths::none && !option.choices.empty()) {
        // _alternative takes each as one word in double quotes.
        return fmt::format("{}:{{_alternative \"words\\:word\\:({})\" \"files\\:file\\:_files\"}}",
                           zsh_quoted(option.value), fmt::join(option.choices, " "));
    }
    if (option.paths != Paths::none) {
        words = option.paths == Paths::folders ? "_files -/" : "_files";
    } else {
        words = option.choices.empty() ? " " : fmt::format("({})", fmt::join(option.choices, " "));
    }
    return fmt::format("{}:{}", zsh_quoted(option.value), words);
}

std::string arguments(const CommandInfo& command)
{
    std::string result;
    for (const OptionInfo& option : command.options) {
        const std::string value = option.value.empty() ? "" : ":" + action(option);
        for (const std::string& name : option.names) {
            const bool is_long = name.starts_with("--");
            const char* equals = option.value.empty()           ? ""
                                 : option.value_may_be_left_out ? "=-"
                                 : is_long                      ? "="
                                                                : "";
            result += fmt::format("        '*{}{}[{}]{}' \\\n", name, equals,
                                  zsh_quoted(extract_summary(option.text)), value);
        }
    }
    for (const OptionInfo& argument : command.arguments) {
        result +=
            fmt::format("        '{}:{}' \\\n", argument.repeats ? "*" : "", action(argument));
    }
    return result;
}

}  // namespace

std::string zsh_completion(std::span<const CommandInfo> commands)
{
    std::string result =
        "#compdef bdpt\n# Completion of bdpt in zsh; made from the options of the command.\n\n"
        "_bdpt() {\n  local -a commands\n  commands=(\n";
    for (const CommandInfo& command : commands) {
        result += fmt::format("    '{}:{}'\n", command.name, zsh_quoted(command.text));
    }
    result +=
        "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
        "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
    for (const CommandInfo& command : commands) {
        result += fmt::format("    {})\n      _arguments -s \\\n{}        && return\n      ;;\n",
                              command.name, arguments(command));
    }
    return result + "  esac\n}\n\n_bdpt \"$@\"\n";
}

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
