#include "commands/commands.h"

#include <optional>
#include <string>

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

namespace {

constexpr int merge_incomplete = 12;  // exit code

constexpr const char* merge_footer = R"(Examples:
  bdpt merge job/*.part.exr -o out.exr -o out.png
  bdpt merge job/*.part.exr -o now.png --partial
  bdpt merge job/0-*.part.exr -o job-0.part.exr
  bdpt merge --plan job/plan.json --wait

Parts come from bdpt render --part, in any order; the image is bit-identical to one render of all
their samples. A part contained in another one is skipped with a note. AOV layers of the parts are
written to .exr files.

Exit codes: 0 done, 12 samples are missing (the message says which, and the command that renders
them; nothing is written without --partial), 2 wrong usage, 3 part not found, 4 a part is broken,
of another render, or overlaps another one, 6 output cannot be written, 7 out of memory.)";

int run_merge(const MergeArguments& arguments)
{
    TerminalConsole console(arguments.printed.format, arguments.printed.verbosity);
    // Stops need no clean finish, but must leave no partial files.
    SignalInterrupt interrupt({}, [] {});
    const std::optional<std::string> missing = merge_parts(arguments, console, interrupt);
    if (missing) {
        report_error(arguments.printed.format, merge_incomplete, *missing);
    }
    return missing ? merge_incomplete : 0;
}

}  // namespace

void add_merge_command(Program& program)
{
    add_command<MergeArguments>(program, "merge", "Merge separately rendered parts of a render",
                                merge_footer, add_merge_options, checked_by(run_merge));
}

}  // namespace bdpt::app
