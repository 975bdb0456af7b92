#!/bin/bash
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
