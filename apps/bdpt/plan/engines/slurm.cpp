#include <fmt/core.h>

#include "plan/engines/engine_files.h"
#include "plan/engines/template.h"

namespace bdpt::app {
namespace {

constexpr const char* sbatch_script = R"sh(#!/bin/bash
# ./submit.sh [OPTION OF sbatch]... renders plan.json with Slurm and merges the parts. The options apply to the
# tasks, like --time=2:00:00 --cpus-per-task=16. SBATCH_PARTITION and SBATCH_ACCOUNT apply to all jobs.
# Run it again to render what is missing: complete tasks end at once. --array=3,7 runs only these tasks.
# BDPT=/opt/bdpt/bin/bdpt ./submit.sh sets the path of bdpt.
set -eu
cd -- "$(dirname -- "$0")"
job=$(sbatch --parsable "$@" tasks.sbatch)
# afterany: the merge also runs after failed tasks. merge.log then lists the commands that render what is missing.
merge=$(sbatch --parsable --dependency=afterany:"${job%%;*}" merge.sbatch)
echo "tasks: job ${job%%;*}; merge: job ${merge%%;*}, merge.log"
)sh";

constexpr const char* tasks = R"sh(#!/bin/bash
#SBATCH --job-name=bdpt
#SBATCH --array=0-@LAST@
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=task-%a.log
#SBATCH --signal=B:USR1@120
# Renders one task of plan.json. Its part survives the time limit, a preempted node and a killed process, and the task
# resumes from it when Slurm starts it again.
"${BDPT:-bdpt}" render --plan plan.json --task "$SLURM_ARRAY_TASK_ID" --quiet \
  ${SLURM_CPUS_PER_TASK:+--threads "$SLURM_CPUS_PER_TASK"} &
task=$!
# Slurm sends this signal before the time limit. It is not TERM, because scancel sends that.
time_is_over=
trap 'time_is_over=1; kill -TERM "$task" 2>/dev/null' USR1
trap 'kill -TERM "$task" 2>/dev/null' TERM

# A signal ends "wait" early, with a code above 128.
while :; do
  wait "$task"
  code=$?
  kill -0 "$task" 2>/dev/null || break
done
wait "$task" 2>/dev/null
last=$?
[ "$last" = 127 ] || code=$last

# Slurm itself restarts tasks only after a node failure.
again() {
  if [ "${SLURM_RESTART_COUNT:-0}" -lt "$1" ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
  fi
}
if [ -n "$time_is_over" ] && [ "$code" = 143 ]; then
  again 1000
elif [ "$code" = 137 ]; then # killed: for want of memory, perhaps
  again 3
fi
exit "$code"
)sh";

constexpr const char* merge = R"sh(#!/bin/bash
#SBATCH --job-name=bdpt-merge
#SBATCH --output=merge.log
# Merges the images of plan.json. Exit code 12: samples are missing; merge.log lists the tasks.
exec "${BDPT:-bdpt}" merge --plan plan.json
)sh";

}  // namespace

std::vector<EngineFile> slurm_files(const Plan& plan)
{
    const std::string last = fmt::format("{}", plan.tasks.size() - 1);
    return {{.name = "submit.sh", .text = sbatch_script, .kind = FileKind::program},
            {.name = "tasks.sbatch", .text = filled(tasks, {{"LAST", last}})},
            {.name = "merge.sbatch", .text = merge}};
}

}  // namespace bdpt::app
