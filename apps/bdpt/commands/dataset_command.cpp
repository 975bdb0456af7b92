#include "commands/commands.h"

#include "dataset/dataset.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

constexpr const char* dataset_footer = R"(Examples:
  bdpt dataset models/*.glb -o out
  bdpt dataset models/*.glb -o out --views 100 --aov depth,normal,mask --background transparent
  bdpt dataset chair.glb -o out --view-range -60:60,0:45 --distance 0.9:1.5 --env 'hdr/*.exr'
  bdpt dataset chair.glb -o again --poses out/chair/transforms.json
  bdpt dataset walk.glb -o out --frames 0:47 --fps 24 --aov flow
  bdpt dataset 'models/*.glb' -o out --share 3/16

Each model gets a folder with its views, their poses (transforms.json, as nerfstudio reads it) and a
manifest; docs/dataset.md describes all files. What a view shows depends on --seed, the model and the
number of the view alone. A model that fails is a line in manifest.jsonl, and the others go on. The
same command again renders what is missing.

Exit codes: 0 done, 2 wrong usage, 3 model not found, 4 invalid model, 5 unsupported feature,
6 output cannot be written (also: it has views of other options), 7 out of memory or time; with
several models that of the first one that failed. 129 stopped by SIGHUP, 130 by SIGINT, 143 by
SIGTERM.)";

int run_dataset_command(const DatasetRequest& request, OptionList& options, const Words& /*words*/)
{
    const DatasetArguments arguments = checked(request, options);
    const Printed& printed = arguments.render.printed;
    TerminalConsole console(printed.format, printed.verbosity);
    SignalInterrupt interrupt({}, [&console] {
        console.note("stopping; the same command goes on; interrupt again to quit at once");
    });
    const int code = job::run_dataset(
        arguments, console, interrupt, [&printed](int exit_code, const std::string& message) {
            report_error(printed.format, exit_code, message);
        });
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : code;
}

}  // namespace

void add_dataset_command(Program& program)
{
    Command& command = add_command<DatasetRequest>(
        program, "dataset", "Render views of many models, with poses, depth and masks",
        dataset_footer, add_dataset_options, run_dataset_command);
    command.essentials = {{"models"},       {"--output"}, {"--views"}, {"--view-range"},
                          {"--distance"},   {"--fov"},    {"--poses"}, {"--aov"},
                          {"--coco"},       {"--spp"},    {"--size"},  {"--env"},
                          {"--background"}, {"--seed"},   {"--share"}, {"--model-time"}};
}

}  // namespace bdpt::app
