#include "commands/commands.h"

#include "run/run_render.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

constexpr const char* plan_footer = R"(Examples:
  bdpt plan scene.glb -o out.exr --spp 4096 --parts 64 --for slurm -d job
  bdpt plan scene.glb -o out.exr --spp 4096 --minutes 20 --for make -d job
  bdpt plan walk.glb -o out.####.exr --frames 1:48 --fps 24 --parts 12 --for make -d job
  make -C job -j4 -k

The folder of -d gets plan.json and the files of the system that starts the tasks; their first lines
say how. A task is bdpt render --plan job/plan.json --task 3; bdpt merge --plan job/plan.json writes
the images. Other systems can start them, too: docs/farm.md has AWS Batch and OpenCue. The plan
fixes the choice of --integrator auto, the instruction set of this machine and the rates of
--adaptive (rates.exr); each task checks that its scene is the planned one. Relative paths stay
relative to the plan, for machines that have the same folders elsewhere.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 input not found, 4 invalid input,
5 unsupported feature, 6 output cannot be written (also: the folder has another plan), 7 out of
memory.)";

int run_plan(const PlanArguments& arguments)
{
    const Printed& printed = arguments.render.printed;
    TerminalConsole console(printed.format, printed.verbosity);
    make_plan(arguments, console);
    return 0;
}

}  // namespace

void add_plan_command(Program& program)
{
    add_command<PlanRequest>(program, "plan", "Distribute a render over processes or machines",
                             plan_footer, add_plan_options, checked_by(run_plan));
}

}  // namespace bdpt::app
