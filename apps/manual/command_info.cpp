#include "manual.h"

#include <algorithm>
#include <sstream>

namespace bdpt::manual {
namespace {

std::vector<std::string> split(const std::string& text, char at)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) {
        parts.push_back(part);
    }
    return parts;
}

/// Blocks of lines between empty lines.
std::vector<std::string> paragraphs(const std::string& text)
{
    std::vector<std::string> result;
    std::string paragraph;
    for (const std::string& line : split(text + "\n\n", '\n')) {
        if (!line.empty()) {
            paragraph += paragraph.empty() ? line : "\n" + line;
        } else if (!paragraph.empty()) {
            result.push_back(std::move(paragraph));
            paragraph.clear();
        }
    }
    return result;
}

/// Placeholders are in capitals: "FILE|none" may be the word "none".
bool is_word(const std::string& choice)
{
    return !choice.empty() && std::all_of(choice.begin(), choice.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    });
}

OptionInfo option_info(const app::Option& option)
{
    OptionInfo info{.names = split(option.names, ','),
                    .value = option.value,
                    .value_may_be_left_out = option.is_flag(),
                    .repeats = option.repeats,
                    .text = option.help,
                    .group = option.is_argument()     ? ""
                             : option.section.empty() ? "Options"
                                                      : option.section,
                    .choices = {}};
    for (const std::string& choice : split(info.value, '|')) {
        if (is_word(choice)) {
            info.choices.push_back(choice);
        }
        if (choice == "FILE" || choice == "PART") {
            info.paths = Paths::files;
        } else if ((choice == "DIR" || choice == "FOLDER") && info.paths == Paths::none) {
            info.paths = Paths::folders;
        }
    }
    return info;
}

}  // namespace

std::string extract_summary(const std::string& text)
{
    std::string shown;
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' ? 1 : 0;
        if (depth == 0) {
            shown += c;
        } else if (c == ')' && --depth == 0 && shown.ends_with(' ')) {
            shown.pop_back();
        }
    }
    return shown.substr(0, std::min(shown.find(". "), shown.find("; ")));
}

CommandInfo describe_program(const app::Program& program)
{
    const OptionInfo help{.names = {"-h", "--help"},
                          .value = "",
                          .text = "Print this help message and exit",
                          .group = "Options",
                          .choices = {}};
    const OptionInfo version{.names = {"--version"},
                             .value = "",
                             .text =
                                 "Print the versions of bdpt and libraries, and the instruction "
                                 "set",
                             .group = "Options",
                             .choices = {}};
    return {.name = program.name,
            .text = program.summary,
            .options = {help, version},
            .arguments = {},
            .footer = paragraphs(program.footer)};
}

std::vector<CommandInfo> describe_commands(const app::Program& program)
{
    std::vector<CommandInfo> commands;
    for (const app::Command& command : program.commands) {
        CommandInfo& info = commands.emplace_back();
        info.name = command.name;
        info.text = command.summary;
        info.options.push_back(describe_program(program).options.front());
        if (!command.essentials.empty()) {
            info.options.push_back({.names = {"--help-all"},
                                    .value = "",
                                    .text = "Print the help of all options",
                                    .group = "Options",
                                    .choices = {}});
        }
        info.footer = paragraphs(command.footer);
        for (const app::Option& option : command.options.all()) {
            (option.is_argument() ? info.arguments : info.options).push_back(option_info(option));
        }
    }
    std::vector<std::string> names;
    for (const CommandInfo& command : commands) {
        names.push_back(command.name);
    }
    for (CommandInfo& command : commands) {
        for (OptionInfo& argument : command.arguments) {
            if (argument.value == "COMMAND") {
                argument.choices = names;
            }
        }
    }
    return commands;
}

}  // namespace bdpt::manual
