#include "manual.h"

#include <algorithm>
#include <utility>

#include "options/value_types.h"

namespace bdpt::manual {
namespace {

/// Blocks of lines between empty lines.
std::vector<std::string> paragraphs(const std::string& text)
{
    std::vector<std::string> result;
    std::string paragraph;
    const std::string lines = text + "\n";
    for (const std::string_view line : job::split(lines, '\n')) {
        if (!line.empty()) {
            paragraph += (paragraph.empty() ? "" : "\n") + std::string(line);
        } else if (!paragraph.empty()) {
            result.push_back(std::move(paragraph));
            paragraph.clear();
        }
    }
    return result;
}

/// Placeholders are in capitals: "FILE|none" may be the word "none".
bool is_word(std::string_view choice)
{
    return !choice.empty() && std::all_of(choice.begin(), choice.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    });
}

constexpr std::string_view command_value = "COMMAND";  // of an argument

job::Option make_flag(std::string names, std::string help)
{
    job::Option flag;
    flag.names = std::move(names);
    flag.help = std::move(help);
    return flag;
}

}  // namespace

std::vector<std::string> list_names(const job::Option& option)
{
    const std::vector<std::string_view> names = job::split(option.names, ',');
    return {names.begin(), names.end()};
}

std::vector<std::string> list_choices(const job::Option& option)
{
    if (!option.info.words.empty() && option.value == command_value) {
        return option.info.words;
    }
    std::vector<std::string_view> choices = job::split(option.value, '|');
    std::erase_if(choices, [](std::string_view choice) { return !is_word(choice); });
    return {choices.begin(), choices.end()};
}

Paths find_paths(const job::Option& option)
{
    Paths paths = Paths::none;
    for (const std::string_view choice : job::split(option.value, '|')) {
        if (choice == "FILE" || choice == "PART") {
            paths = Paths::files;
        } else if ((choice == "DIR" || choice == "FOLDER") && paths == Paths::none) {
            paths = Paths::folders;
        }
    }
    return paths;
}

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
    std::vector<job::Option> flags{
        make_flag("-h,--help", "Print this help message and exit"),
        make_flag("--version",
                  "Print the versions of bdpt and libraries, and the instruction set")};
    return {.name = program.name,
            .text = program.summary,
            .options = std::move(flags),
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
            info.options.push_back(make_flag("--help-all", "Print the help of all options"));
        }
        info.footer = paragraphs(command.footer);
        for (const job::Option& option : command.options.all()) {
            (option.is_argument() ? info.arguments : info.options).push_back(option);
        }
    }
    for (CommandInfo& command : commands) {
        for (job::Option& argument : command.arguments) {
            for (std::size_t i = 0; argument.value == command_value && i < commands.size(); ++i) {
                argument.info.words.push_back(commands[i].name);
            }
        }
    }
    return commands;
}

}  // namespace bdpt::manual
