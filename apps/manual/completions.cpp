#include "manual.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace bdpt::manual {
namespace {

/// A line of _bdpt_values; empty for flags.
std::string values(const CommandInfo& command, const job::Option& option)
{
    if (option.value.empty()) {
        return "";
    }
    std::string words = fmt::format("{}", fmt::join(list_choices(option), " "));
    words += find_paths(option) == Paths::files     ? " @files"
             : find_paths(option) == Paths::folders ? " @folders"
                                                    : "";
    std::string patterns;
    for (const std::string& name : list_names(option)) {
        patterns += fmt::format("{}{}:{}", patterns.empty() ? "" : "|", command.name,
                                option.is_argument() ? "" : name);
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
        for (const job::Option& option : command.options) {
            own += (own.empty() ? "" : " ") + option.name();
            words += values(command, option);
        }
        for (const job::Option& argument : command.arguments) {
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
std::string action(const job::Option& option)
{
    std::string words;
    if (find_paths(option) != Paths::none && !list_choices(option).empty()) {
        // _alternative takes each as one word in double quotes.
        return fmt::format("{}:{{_alternative \"words\\:word\\:({})\" \"files\\:file\\:_files\"}}",
                           zsh_quoted(option.value), fmt::join(list_choices(option), " "));
    }
    if (find_paths(option) != Paths::none) {
        words = find_paths(option) == Paths::folders ? "_files -/" : "_files";
    } else {
        words = list_choices(option).empty()
                    ? " "
                    : fmt::format("({})", fmt::join(list_choices(option), " "));
    }
    return fmt::format("{}:{}", zsh_quoted(option.value), words);
}

std::string arguments(const CommandInfo& command)
{
    std::string result;
    for (const job::Option& option : command.options) {
        const std::string value = option.value.empty() ? "" : ":" + action(option);
        for (const std::string& name : list_names(option)) {
            const bool is_long = name.starts_with("--");
            const char* equals = !option.is_flag() && is_long ? "=" : "";
            result += fmt::format("        '*{}{}[{}]{}' \\\n", name, equals,
                                  zsh_quoted(extract_summary(option.help)), value);
        }
    }
    for (const job::Option& argument : command.arguments) {
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

std::string option_line(const CommandInfo& command, const job::Option& option)
{
    std::string line =
        fmt::format("complete -c bdpt -n '__fish_seen_subcommand_from {}'", command.name);
    for (const std::string& name : list_names(option)) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    // -x: a value, and no files; -r -F: a value, and files too.
    if (!option.value.empty()) {
        line += find_paths(option) == Paths::files ? " -r -F" : " -x";
    }
    std::string words = fmt::format("{}", fmt::join(list_choices(option), " "));
    words += find_paths(option) == Paths::folders ? "(__fish_complete_directories)" : "";
    if (!words.empty()) {
        line += " -a " + fish_quoted(words);
    }
    return line + " -d " + fish_quoted(extract_summary(option.help)) + "\n";
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
        for (const job::Option& option : command.options) {
            result += option_line(command, option);
        }
        for (const job::Option& argument : command.arguments) {
            result +=
                fmt::format("complete -c bdpt -n '__fish_seen_subcommand_from {}'{}{}\n",
                            command.name, find_paths(argument) == Paths::files ? " -F" : "",
                            list_choices(argument).empty()
                                ? ""
                                : fmt::format(" -a '{}'", fmt::join(list_choices(argument), " ")));
        }
    }
    return result;
}

}  // namespace bdpt::manual
