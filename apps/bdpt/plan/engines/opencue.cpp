#include <fmt/core.h>

#include <cstddef>

#include "plan/engines/engine_files.h"
#include "terminal/text.h"

namespace bdpt::app {

std::vector<EngineFile> opencue_files(const Plan& plan, const std::filesystem::path& folder)
{
    const std::string file = shell_word((folder / "plan.json").string());
    std::string commands;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        commands += fmt::format("bdpt render --plan {} --task {}\n", file, i);
    }
    return {{.name = "commands.txt", .text = commands}};
}

}  // namespace bdpt::app
