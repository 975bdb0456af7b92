#include <fmt/core.h>
#include <fmt/format.h>

#include "completions.h"

namespace bdpt::manual {
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

}  // namespace bdpt::manual
