// bdpt_manual FOLDER: writes the man pages and the completions of bdpt there, from the options that
// the command has.

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "commands/commands.h"
#include "manual.h"
#include "options/option_list.h"

namespace bdpt::manual {
namespace {

void write(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream stream(file);
    stream << text;
    stream.close();
    if (!stream) {
        throw std::runtime_error("cannot write " + file.string());
    }
}

void write_all(const std::filesystem::path& folder)
{
    const app::CommandLine line;
    const CommandInfo program = describe_program(line.program);
    const std::vector<CommandInfo> commands = describe_commands(line.program);
    write(folder / "man1/bdpt.1", man_page(program, commands));
    for (const CommandInfo& command : commands) {
        const bool is_more_than_help = command.options.size() > 1;
        if (is_more_than_help) {
            write(folder / ("man1/bdpt-" + command.name + ".1"), man_page(command));
        }
    }
    write(folder / "job.schema.json", app::job_schema(line.program.find("render")->options));
    write(folder / "bash/bdpt", bash_completion(commands));
    write(folder / "zsh/_bdpt", zsh_completion(commands));
    write(folder / "fish/bdpt.fish", fish_completion(commands));
}

}  // namespace
}  // namespace bdpt::manual

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "Usage: bdpt_manual FOLDER\n";
        return 2;
    }
    try {
        bdpt::manual::write_all(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "bdpt_manual: " << error.what() << "\n";
        return 1;
    }
    return EXIT_SUCCESS;
}
