#include "parser/command_parser.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <sstream>
#include <utility>

#include "messages/text.h"
#include "options/value_types.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

constexpr std::string_view help_all = "--help-all";

/// Formats options as "--name VALUE   description", as wide as the terminal, within 60 to 100
/// columns.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() : columns_(std::clamp(output_columns().value_or(100), 60, 100))
    {
        column_width(columns_ < 80 ? 26 : 32);
    }
    std::string make_option_opts(const CLI::Option* option) const override
    {
        const std::string value = option->get_type_name();
        return value.empty() ? "" : " " + value;
    }
    std::string make_option_desc(const CLI::Option* option) const override
    {
        return wrapped(option->get_description(),
                       static_cast<std::size_t>(columns_) - get_column_width());
    }
    std::string make_footer(const CLI::App* app) const override
    {
        return wrapped_paragraphs(CLI::Formatter::make_footer(app),
                                  static_cast<std::size_t>(columns_));
    }

private:
    int columns_;
};

/// Converts `words` for CLI11, which takes them from the end. "--name=" becomes "--name" and an
/// empty word, as CLI11 would take the next word as its value.
std::vector<std::string> words_for_cli(const std::vector<std::string>& words)
{
    std::vector<std::string> result;
    bool takes_options = true;
    for (const std::string& word : words) {
        takes_options = takes_options && word != "--";
        const bool is_empty =
            takes_options && word.starts_with("--") && word.find('=') == word.size() - 1;
        result.push_back(is_empty ? word.substr(0, word.size() - 1) : word);
        if (is_empty) {
            result.emplace_back();
        }
    }
    std::reverse(result.begin(), result.end());
    return result;
}

/// Options registered with CLI11, which separates the words; `Option::store` parses the values.
class CliOptions {
public:
    /// Help shows the options `shown`, without sections; empty: all of them.
    void add(CLI::App& app, OptionList& list, std::span<const Essential> shown = {})
    {
        for (Option& option : list.all()) {
            CLI::Option* added = add(app, option);
            const auto found = std::find_if(shown.begin(), shown.end(), [&](const Essential& one) {
                return one.name == option.name();
            });
            if (shown.empty()) {
                if (!option.section.empty()) {
                    added->group(option.section);
                }
            } else if (found == shown.end()) {
                added->group("");
            } else if (!found->brief.empty()) {
                added->description(std::string(found->brief));
            }
            added->required(option.required);
            added_.emplace_back(&option, added);
        }
    }

    /// Transfers the given texts to the options of `list`, and stores their values.
    void store(OptionList& list) const
    {
        for (const auto& [option, added] : added_) {
            option->texts = added->count() > 0 ? added->results() : std::vector<std::string>();
        }
        list.store_given();
    }

private:
    CLI::Option* add(CLI::App& app, Option& option)
    {
        if (option.is_flag()) {
            CLI::Option* flag = app.add_flag(option.names, flags_.emplace_back(), option.help);
            return flag->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        }
        const CLI::callback_t accept = [](const CLI::results_t&) { return true; };
        CLI::Option* added = app.add_option(option.names, accept, option.help);
        added->type_name(option.value);
        if (!option.repeats) {
            return added->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        }
        added->expected(1, CLI::detail::expected_max_vector_size);
        return added->allow_extra_args(option.is_argument());
    }

    std::deque<std::string> flags_;
    std::vector<std::pair<Option*, CLI::Option*>> added_;
};

/// Returns "render, plan or merge".
std::string command_names(const Program& program)
{
    std::vector<std::string> names;
    for (const Command& command : program.commands) {
        if (!command.options.all().empty() && command.name != "help") {
            names.push_back(command.name);
        }
    }
    return words_text(names);
}

/// The program's command line as a CLI11 parser.
struct CommandLineParser {
    explicit CommandLineParser(Program& program, HelpDetail detail = HelpDetail::essentials)
        : app(program.summary, program.name)
    {
        app.set_version_flag("--version", program.version,
                             "Print the versions of bdpt and libraries, and the instruction set");
        app.require_subcommand(1);
        app.footer(program.footer);
        app.formatter(std::make_shared<HelpFormatter>());
        for (Command& command : program.commands) {
            CLI::App* added = app.add_subcommand(command.name, command.summary);
            added->footer(command.footer);
            const bool is_short = detail == HelpDetail::essentials;
            options.emplace_back().add(
                *added, command.options,
                is_short ? std::span(command.essentials) : std::span<const Essential>());
            if (!command.essentials.empty()) {
                added->add_flag(std::string(help_all), all_flag,
                                "Print the help of all options, with examples and exit codes");
            }
            if (is_short && !command.essentials.empty()) {
                added->footer(command.short_footer);
            }
        }
    }

    CLI::App app;
    std::deque<CliOptions> options;  ///< one per command
    bool all_flag = false;
};

/// Returns the help command for `command`; null: for the program.
std::string format_help_command(const CLI::App* command)
{
    return command != nullptr ? fmt::format("bdpt {} --help", command->get_name()) : "bdpt --help";
}

/// Returns the message of `error` in our words.
std::string complaint(const CLI::ParseError& error)
{
    std::string text = error.what();
    const std::string name = text.substr(0, text.find_first_of(": "));
    constexpr std::string_view before = ": 1 required ";
    constexpr std::string_view after = " missing";
    const std::size_t begin = text.find(before);
    if (begin != std::string::npos && text.ends_with(after)) {
        text = text.substr(begin + before.size());
        return fmt::format("{} needs a value, {}", name,
                           text.substr(0, text.size() - after.size()));
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && name == "files") {
        return "files are required";
    }
    return text;
}

/// Returns one line for a parse error, with a hint. `command`: the given command, or null.
std::string explain(const Program& program, const CLI::App& app, const CLI::App* command,
                    const CLI::ParseError& error)
{
    const std::string help = format_help_command(command);
    const std::vector<std::string> extras = app.remaining(true);
    if (extras.empty()) {
        const bool no_command =
            command == nullptr && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
        return no_command ? fmt::format("no command: expected {}; see \"{}\"",
                                        command_names(program), help)
                          : fmt::format("{}; see \"{}\"", complaint(error), help);
    }
    const std::string& word = extras.front();
    const Command* const known = command != nullptr ? program.find(command->get_name()) : nullptr;
    if (!word.starts_with("-")) {
        const bool is_scene = word.ends_with(".gltf") || word.ends_with(".glb");
        if (command == nullptr && is_scene) {
            return fmt::format("unknown command \"{0}\"; \"bdpt render {0}\" renders a scene",
                               word);
        }
        return command == nullptr
                   ? unknown_command(program, word, help)
                   : fmt::format("unexpected argument \"{}\"; see \"{}\"", word, help);
    }
    const std::string name = word.substr(0, word.find('='));
    if (const auto advice =
            advice_for_option(name, known != nullptr ? known->options : OptionList())) {
        return fmt::format("unknown option {}: {}; see \"{}\"", name, *advice, help);
    }
    if (known != nullptr && known->options.find(name) != nullptr) {
        return fmt::format("{} comes after the command, as in bdpt {} {}; see \"{}\"", name,
                           known->name, word, help);
    }
    std::vector<std::string> names;
    for (const CLI::Option* option : (command != nullptr ? *command : app).get_options()) {
        for (const std::string& long_name : option->get_lnames()) {
            names.push_back("--" + long_name);
        }
    }
    const std::optional<std::string> meant = closest(name, names);
    return fmt::format("unknown option {}{}; see \"{}\"", name,
                       meant ? fmt::format(" (did you mean {}?)", *meant) : "", help);
}

}  // namespace

const Command* Program::find(std::string_view wanted) const
{
    const auto found =
        std::find_if(commands.begin(), commands.end(),
                     [wanted](const Command& command) { return command.name == wanted; });
    return found != commands.end() ? &*found : nullptr;
}

std::string unknown_command(const Program& program, const std::string& word,
                            const std::string& help)
{
    std::vector<std::string> names;
    for (const Command& command : program.commands) {
        names.push_back(command.name);
    }
    const std::optional<std::string> near = closest(word, names);
    const std::optional<std::string_view> same = command_for(word);
    return fmt::format("unknown command \"{}\"{}: expected {}; see \"{}\"", word,
                       same || near ? fmt::format(" (did you mean {}?)", same ? *same : *near) : "",
                       command_names(program), help);
}

ParsedLine parse(Program& program, const std::vector<std::string>& words)
{
    const auto end = std::find(words.begin(), words.end(), "--");
    const Command* const first = program.find(words.front());
    if (std::find(words.begin(), end, help_all) != end) {
        return {.text = help_text(program, first != nullptr ? first->name : "", HelpDetail::all)};
    }
    if (first != nullptr) {
        check_dashes(words, first->options);
    }
    // Errors name options that the short help hides, too.
    CommandLineParser parser(program, HelpDetail::all);
    const auto given = [&parser]() -> const CLI::App* {
        const std::vector<CLI::App*> commands = parser.app.get_subcommands();
        return commands.empty() ? nullptr : commands.front();
    };
    try {
        parser.app.parse(words_for_cli(words));
    } catch (const CLI::CallForHelp&) {
        return {.text = help_text(program, given() != nullptr ? given()->get_name() : "")};
    } catch (const CLI::Success& success) {
        std::ostringstream text;
        parser.app.exit(success, text, text);
        return {.text = text.str()};
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::usage, explain(program, parser.app, given(), error));
    }
    for (std::size_t i = 0; i < program.commands.size(); ++i) {
        Command& command = program.commands[i];
        if (command.name == given()->get_name()) {
            parser.options[i].store(command.options);
            return {.command = &command};
        }
    }
    throw Error(ErrorCode::internal, "the parser found an unknown command");
}

void parse(OptionList& options, const std::vector<std::string>& words)
{
    CLI::App app;
    CliOptions added;
    added.add(app, options);
    try {
        app.parse(words_for_cli(words));
    } catch (const CLI::ParseError& error) {
        throw OptionError(complaint(error));
    }
    added.store(options);
}

std::string help_text(Program& program, std::string_view command, HelpDetail detail)
{
    const CommandLineParser parser(program, detail);
    if (command.empty()) {
        return parser.app.help();
    }
    return parser.app.get_subcommand(std::string(command))->help("bdpt");
}

}  // namespace bdpt::app
