#include <fmt/core.h>

#include <cstddef>

#include "plan/engines/engine_files.h"
#include "plan/engines/template.h"

namespace bdpt::app {
namespace {

// Tasks are phony: whether one is done is for bdpt to say, which looks at the samples that are in
// its part. Time stamps would take the checkpoint of a killed task for the whole.
constexpr const char* makefile =
    R"(# make -j4 -k: renders four tasks of plan.json at a time, and merges them.
# Again: what is missing; tasks that are done end at once.
# make -j4 -k THREADS=8 BDPT=/opt/bdpt/bin/bdpt: threads of each task, and where bdpt is.
BDPT := bdpt
THREADS :=

tasks :=@TASKS@

.PHONY: merge $(tasks)

merge: $(tasks)
	$(BDPT) merge --plan plan.json

$(tasks): task-%:
	$(BDPT) render --plan plan.json --task $* --quiet $(THREADS:%=--threads %)
)";

}  // namespace

std::vector<EngineFile> make_files(const Plan& plan)
{
    std::string tasks;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        tasks += fmt::format(" task-{}", i);
    }
    return {{.name = "Makefile", .text = filled(makefile, {{"TASKS", tasks}})}};
}

}  // namespace bdpt::app
