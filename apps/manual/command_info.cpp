#include "command_info.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "terminal/help_formatter.h"

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

OptionInfo option_info(const CLI::Option& option)
{
    OptionInfo info{.names = {},
                    .value = option.get_items_expected_max() == 0 ? "" : app::value_of(option),
                    .value_may_be_left_out = option.get_items_expected_min() == 0,
                    .repeats = option.get_items_expected_max() > 1,
                    .text = option.get_description(),
                    .group = option.get_positional() ? "" : option.get_group(),
                    .choices = {}};
    if (option.get_positional()) {
        info.names.push_back(option.get_single_name());
    }
    for (const std::string& name : option.get_snames()) {
        info.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        info.names.push_back("--" + name);
    }
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

std::string summary_of(const std::string& text)
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

CommandInfo info_of(const CLI::App& app)
{
    CommandInfo info{.name = app.get_name(),
                     .text = app.get_description(),
                     .options = {},
                     .arguments = {},
                     .footer = paragraphs(app.get_footer())};
    for (const CLI::Option* option : app.get_options()) {
        (option->get_positional() ? info.arguments : info.options).push_back(option_info(*option));
    }
    return info;
}

std::vector<CommandInfo> commands_of(const CLI::App& app)
{
    std::vector<CommandInfo> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(info_of(*command));
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
