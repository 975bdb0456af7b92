#include <bdpt/error.h>
#include <bdpt/thread_limit.h>
#include <fmt/core.h>
#include <signal.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands/bench_command.h"
#include "commands/command_line.h"
#include "commands/compare_command.h"
#include "commands/info_command.h"
#include "commands/inspect_command.h"
#include "commands/merge_command.h"
#include "commands/plan_command.h"
#include "commands/render_command.h"
#include "commands/verify_command.h"
#include "commands/version_command.h"
#include "options/arguments.h"
#include "options/command_options.h"
#include "plan/planned_words.h"
#include "terminal/cgroup_limits.h"
#include "terminal/console.h"
#include "terminal/standard_streams.h"

namespace bdpt::app {
namespace {

/// All long names of the options of `command`.
std::vector<std::string> option_names(const CLI::App& command)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

/// The command that was given, or null.
const CLI::App* command_of(const CommandLine& line)
{
    const std::vector<CLI::App*> commands = line.app.get_subcommands();
    return commands.empty() ? nullptr : commands.front();
}

/// Where all about the command is told.
std::string help_of(const CommandLine& line)
{
    const CLI::App* command = command_of(line);
    return command != nullptr ? fmt::format("bdpt {} --help", command->get_name()) : "bdpt --help";
}

constexpr const char* commands = "render, plan, merge, info, compare, bench, verify and inspect";

std::string unknown_command(const std::string& word, const std::string& help)
{
    return fmt::format("unknown command \"{}\": there are {}; see \"{}\"", word, commands, help);
}

/// The message of CLI11, reworded where CLI11 does not say what is expected.
std::string message_of(const CommandLine& line, const CLI::ParseError& error)
{
    const std::string message = error.what();
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        // "Could not convert: --fov = x"; words are never converted, only numbers.
        const std::size_t colon = message.find(": ");
        const std::size_t equals = message.find(" = ");
        if (colon != std::string::npos && equals != std::string::npos && colon < equals) {
            return fmt::format("{}: expected a number, but got \"{}\"",
                               message.substr(colon + 2, equals - colon - 2),
                               message.substr(equals + 3));
        }
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
        // "--a excludes --b"
        constexpr std::string_view excludes = " excludes ";
        const std::size_t at = message.find(excludes);
        if (at != std::string::npos) {
            return fmt::format("{} cannot be combined with {}", message.substr(0, at),
                               message.substr(at + excludes.size()));
        }
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && command_of(line) == nullptr) {
        return fmt::format("no command: there are {}", commands);
    }
    return message;
}

/// One line for what the parser did not like, with a hint.
std::string explain(const CommandLine& line, const CLI::ParseError& error)
{
    const CLI::App* command = command_of(line);
    const std::string help = help_of(line);
    const std::vector<std::string> extras = line.app.remaining(true);
    if (extras.empty()) {
        return fmt::format("{}; see \"{}\"", message_of(line, error), help);
    }
    const std::string& word = extras.front();
    if (command == nullptr && !word.starts_with("-")) {
        return unknown_command(word, help);
    }
    if (!word.starts_with("-")) {
        return fmt::format("unexpected argument \"{}\"; see \"{}\"", word, help);
    }
    const std::string name = word.substr(0, word.find('='));
    const std::optional<std::string> meant =
        closest(name, option_names(command != nullptr ? *command : line.app));
    return fmt::format("unknown option {}{}; see \"{}\"", name,
                       meant ? fmt::format(" (did you mean {}?)", *meant) : "", help);
}

/// `bdpt help` and `bdpt help COMMAND`: as `--help`.
int run_help(const CommandLine& line)
{
    if (line.topic.empty()) {
        // app.help() would be that of the command "help".
        print_text(line.app.get_formatter()->make_help(&line.app, line.app.get_name(),
                                                       CLI::AppFormatMode::Normal));
        return 0;
    }
    const auto topics = line.app.get_subcommands(
        [&line](const CLI::App* command) { return command->get_name() == line.topic; });
    if (topics.empty()) {
        throw Error(ErrorCode::usage, unknown_command(line.topic, "bdpt --help"));
    }
    print_text(topics.front()->help("bdpt"));
    return 0;
}

int run_command(const CommandLine& line, const std::vector<std::string>& words)
{
    if (line.help->parsed()) {
        return run_help(line);
    }
    if (line.version->parsed()) {
        print_text(version_text() + "\n");
        return 0;
    }
    if (line.plan->parsed()) {
        return run_plan(understand(line.plan_words));
    }
    if (line.merge->parsed()) {
        return run_merge(understand(line.merge_words));
    }
    if (line.compare->parsed()) {
        return run_compare(understand(line.compare_words));
    }
    if (line.bench->parsed()) {
        return run_bench(understand(line.bench_words), words);
    }
    if (line.verify->parsed()) {
        return run_verify(understand(line.verify_words));
    }
    if (line.inspect->parsed()) {
        return run_inspect(understand(line.inspect_words));
    }
    return line.info->parsed() ? run_info(line.info_arguments)
                               : run_render(understand(line.render_words), words);
}

int run(const std::vector<std::string>& given, Format format)
{
    CommandLine line;
    std::vector<std::string> words = given;
    try {
        words = with_planned_words(given);
        line.app.parse(words_for_parser(std::span(words).subspan(1)));
    } catch (const CLI::Success& help_or_version) {
        return line.app.exit(help_or_version);
    } catch (const OptionError& error) {
        throw Error(error.code(),
                    fmt::format("{}; see \"bdpt {} --help\"", error.what(), given[1]));
    } catch (const CLI::ParseError& error) {
        const int code = static_cast<int>(ErrorCode::usage);
        report_error(format, code, explain(line, error));
        return code;
    }
    try {
        return run_command(line, words);
    } catch (const OptionError& error) {
        throw Error(error.code(), fmt::format("{}; see \"{}\"", error.what(), help_of(line)));
    }
}

/// `work`, by as many threads as the quota of a container lets run at a time, and the system lets
/// start: oneTBB knows of the processors that the process may run on, and not of such limits.
template <typename Work>
int within_quota(const Work& work)
{
    const int quota = cgroup_limits().processors.value_or(int{tbb::task_arena::automatic});
    const int available = tbb::this_task_arena::max_concurrency();
    const int allowed = limit_threads(quota > 0 ? std::min(quota, available) : available).allowed;
    return allowed < available ? tbb::task_arena(allowed).execute(work) : work();
}

/// The exit code. Whatever goes wrong becomes a message.
int guarded_run(const std::vector<std::string>& words, Format format)
{
    const auto fail = [format](ErrorCode code, const char* message) {
        report_error(format, static_cast<int>(code), message);
        return static_cast<int>(code);
    };
    try {
        return within_quota([&] { return run(words, format); });
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::out_of_memory, "out of memory");
    } catch (const std::system_error& error) {
        return error.code() == std::errc::resource_unavailable_try_again
                   ? fail(ErrorCode::out_of_memory,
                          "no thread can be started: the system limits how many this user or "
                          "container may have")
                   : fail(ErrorCode::internal, error.what());
    } catch (const std::exception& error) {
        return fail(ErrorCode::internal, error.what());
    }
}

}  // namespace
}  // namespace bdpt::app

int main(int argc, char** argv)
{
    using namespace bdpt;
    app::guard_standard_streams();
    // A reader of our messages who leaves must not take the image along.
    ::signal(SIGPIPE, SIG_IGN);
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    const bool json = std::any_of(words.begin(), words.end(), [](const char* word) {
        return std::string_view(word) == "--json";
    });
    return app::finish_standard_streams(app::guarded_run(
        {words.begin(), words.end()}, json ? app::Format::json : app::Format::text));
}
