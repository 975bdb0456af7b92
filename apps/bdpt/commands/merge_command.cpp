#include "commands/commands.h"

#include <optional>
#include <string>

#include "run/run_render.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
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
    add_command<MergeRequest>(program, "merge", "Merge separately rendered parts of a render",
                              merge_footer, add_merge_options, checked_by(run_merge));
}

}  // namespace bdpt::app
