#include "plan/engines/engine_files.h"

#include <fmt/core.h>

#include "terminal/text.h"

namespace bdpt::app {

std::vector<EngineFile> engine_files(Engine engine, const Plan& plan,
                                     const std::filesystem::path& folder)
{
    switch (engine) {
        case Engine::slurm:
            return slurm_files(plan);
        case Engine::kubernetes:
            return kubernetes_files(plan, folder);
        case Engine::make:
            return make_files(plan);
        case Engine::opencue:
            return opencue_files(plan, folder);
        case Engine::aws_batch:
            break;
    }
    return aws_batch_files(plan, folder);
}

std::string start_command(Engine engine, const std::filesystem::path& folder)
{
    const std::string name = shell_word(folder.string());
    switch (engine) {
        case Engine::slurm:
            return shell_word((folder / "submit.sh").string());
        case Engine::kubernetes:
            return fmt::format("kubectl apply -f {}",
                               shell_word((folder / "kubernetes.yaml").string()));
        case Engine::make:
            return fmt::format("make -C {} -j4 -k", name);
        case Engine::opencue:
            return fmt::format("cuecmd {}", shell_word((folder / "commands.txt").string()));
        case Engine::aws_batch:
            break;
    }
    return fmt::format("{} QUEUE IMAGE FILESYSTEM", shell_word((folder / "submit.sh").string()));
}

}  // namespace bdpt::app
