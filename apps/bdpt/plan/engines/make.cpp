#include <fmt/core.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "plan/engines/engine_files.h"
#include "plan/engines/template.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

// Tasks are phony: bdpt decides by the samples in a part whether its task is done. By time stamps
// the checkpoint of a killed task would count as complete.
constexpr const char* makefile =
    R"(# make -j4 -k: renders four tasks of plan.json at a time, and merges them.
# Run it again to render what is missing: complete tasks end at once.
# make -j4 -k THREADS=8 BDPT=/opt/bdpt/bin/bdpt sets the threads of each task and the path of bdpt.
BDPT := @PROGRAM@
THREADS :=

tasks :=@TASKS@

.PHONY: merge $(tasks)

merge: $(tasks)
	$(BDPT) merge --plan plan.json

$(tasks): task-%:
	$(BDPT) render --plan plan.json --task $* --quiet $(THREADS:%=--threads %)
)";

/// Returns the path of this program, quoted for a shell in a makefile. make runs on this machine,
/// where `bdpt` may be another program, or none.
std::string this_program()
{
    std::error_code unknown;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    std::string text;
    for (const char c : shell_word(unknown ? "bdpt" : program.string())) {
        text += c == '$' ? "$$" : c == '#' ? "\\#" : std::string(1, c);
    }
    return text;
}

}  // namespace

std::vector<EngineFile> make_files(const Plan& plan)
{
    std::string tasks;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        tasks += fmt::format(" task-{}", i);
    }
    return {{.name = "Makefile",
             .text = filled(makefile, {{"TASKS", tasks}, {"PROGRAM", this_program()}})}};
}

}  // namespace bdpt::app
