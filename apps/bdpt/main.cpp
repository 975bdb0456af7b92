#include <bdpt/error.h>
#include <bdpt/version.h>
#include <fmt/core.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/bench_command.h"
#include "commands/compare_command.h"
#include "commands/info_command.h"
#include "commands/render_command.h"
#include "commands/verify_command.h"
#include "options/arguments.h"
#include "options/bench_arguments.h"
#include "options/compare_arguments.h"
#include "options/render_arguments.h"
#include "options/verify_arguments.h"
#include "terminal/console.h"
#include "terminal/help_formatter.h"

namespace bdpt::app {
namespace {

constexpr const char* footer = R"(Examples:
  bdpt render scene.gltf -o out.exr
  bdpt render scene.glb -o out.exr -o preview.png --spp 256
  bdpt info scene.glb
  bdpt compare out.exr reference.exr
  bdpt bench scene.gltf -o bench --quick
  bdpt verify scene.gltf

"bdpt render --help" has all options and the exit codes.)";

/// The words of a command line and what they fill in.
struct CommandLine {
    CLI::App app{"bdpt renders glTF 2.0 scenes by bidirectional path tracing.", "bdpt"};
    RenderWords render_words;
    InfoArguments info_arguments;
    CompareWords compare_words;
    BenchWords bench_words;
    VerifyWords verify_words;
    CLI::App* render = nullptr;
    CLI::App* info = nullptr;
    CLI::App* compare = nullptr;
    CLI::App* bench = nullptr;
    CLI::App* verify = nullptr;
};

void describe(CommandLine& line)
{
    line.app.set_version_flag("--version", "bdpt " BDPT_VERSION);
    line.app.require_subcommand(1);
    line.app.footer(footer);
    line.app.formatter(std::make_shared<HelpFormatter>());
    line.render = line.app.add_subcommand("render", "Render a scene to .exr and .png files");
    add_render_options(*line.render, line.render_words);
    line.info = line.app.add_subcommand("info", "Say what a scene holds");
    add_info_options(*line.info, line.info_arguments);
    line.compare = line.app.add_subcommand("compare", "Say how far pictures are from a reference");
    add_compare_options(*line.compare, line.compare_words);
    line.bench = line.app.add_subcommand("bench", "Hold integrators against each other");
    add_bench_options(*line.bench, line.bench_words);
    line.verify = line.app.add_subcommand("verify", "Prove the estimators on a scene");
    add_verify_options(*line.verify, line.verify_words);
}

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

/// One line for what the parser did not like, with a hint.
std::string explain(const CommandLine& line, const CLI::ParseError& error)
{
    const CLI::App* command = line.render->parsed()    ? line.render
                              : line.info->parsed()    ? line.info
                              : line.compare->parsed() ? line.compare
                              : line.bench->parsed()   ? line.bench
                              : line.verify->parsed()  ? line.verify
                                                       : nullptr;
    const std::string help =
        command != nullptr ? fmt::format("bdpt {} --help", command->get_name()) : "bdpt --help";
    const std::vector<std::string> extras = line.app.remaining(true);
    if (extras.empty()) {
        return fmt::format("{}; see \"{}\"", error.what(), help);
    }
    const std::string& word = extras.front();
    if (command == nullptr && !word.starts_with("-")) {
        return fmt::format(
            "unknown command \"{}\": there are render, info, compare, bench and verify; see \"{}\"",
            word, help);
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

int run(int argc, char** argv, Format format)
{
    CommandLine line;
    describe(line);
    try {
        line.app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return line.app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        const int code = static_cast<int>(ErrorCode::usage);
        report_error(format, code, explain(line, error));
        return code;
    }
    if (line.compare->parsed()) {
        return run_compare(understand(line.compare_words));
    }
    if (line.bench->parsed()) {
        return run_bench(understand(line.bench_words), {argv, argv + argc});
    }
    if (line.verify->parsed()) {
        return run_verify(understand(line.verify_words));
    }
    return line.info->parsed() ? run_info(line.info_arguments)
                               : run_render(understand(line.render_words));
}

}  // namespace
}  // namespace bdpt::app

int main(int argc, char** argv)
{
    using namespace bdpt;
    // A reader of our messages who leaves must not take the picture along.
    ::signal(SIGPIPE, SIG_IGN);
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    const bool json = std::any_of(words.begin(), words.end(), [](const char* word) {
        return std::string_view(word) == "--json";
    });
    const app::Format format = json ? app::Format::json : app::Format::text;
    const auto fail = [format](ErrorCode code, const char* message) {
        app::report_error(format, static_cast<int>(code), message);
        return static_cast<int>(code);
    };
    try {
        return app::run(argc, argv, format);
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        return fail(ErrorCode::internal, error.what());
    }
}
