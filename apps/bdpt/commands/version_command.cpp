#include "commands/version_command.h"

#include <bdpt/eval/bench/machine.h>
#include <bdpt/scene.h>
#include <bdpt/version.h>
#include <fmt/core.h>

namespace bdpt::app {

std::string version_text()
{
    const eval::MachineFacts facts = eval::machine_facts();
    const Isa isa = Scene(SceneDesc{}).isa();
    return fmt::format("bdpt {}\nLibraries: {}\nCompiler: {}\nInstruction set of Embree here: {}",
                       BDPT_VERSION, facts.libraries, facts.compiler, isa_name(isa));
}

}  // namespace bdpt::app
