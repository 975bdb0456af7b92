#include "commands/verify_command.h"

#include <bdpt/eval/verify/verify.h>
#include <bdpt/eval/verify/verify_json.h>
#include <fmt/core.h>

#include <string>

#include "report/verify_text.h"
#include "stage/prepared_scene.h"
#include "terminal/interrupt.h"
#include "terminal/text.h"

namespace bdpt::app {

int exit_code(eval::Verdict verdict)
{
    switch (verdict) {
        case eval::Verdict::pass:
            return 0;
        case eval::Verdict::fail:
            return verify_failed;
        case eval::Verdict::inconclusive:
            return verify_inconclusive;
    }
    return verify_failed;
}

int run_verify(const VerifyArguments& arguments)
{
    const RenderArguments& what = arguments.stage;
    // stdout has the report alone, so all else goes to stderr in both formats.
    Console console(Format::text, what.verbosity);
    Interrupt interrupt({}, [&console] {
        console.note("stopping after the batches in flight; interrupt again to end at once");
    });
    const PreparedScene stage = prepare_scene(what);
    interrupt.allow_stop();
    const std::string file = what.file.string();
    for (const std::string& warning : stage.warnings) {
        console.warning(warning);
    }
    console.note(fmt::format("{}: {}, {}; {}x{}, camera {}", file,
                             counted(stage.scene.counts().instanced_triangles, "triangle"),
                             counted(stage.lights, "light"), stage.size.width, stage.size.height,
                             stage.camera.name));
    eval::VerifyControl control;
    control.stop = interrupt.stop_token();
    control.on_progress = [&](const eval::VerifyProgress& progress) {
        console.progress({.samples_done = progress.batches * eval::bdpt_samples,
                          .samples_total = 0,
                          .seconds = progress.seconds},
                         {.samples = std::nullopt, .seconds = arguments.options.seconds});
    };
    const eval::VerifyReport report =
        eval::verify(stage.scene, stage.camera, arguments.options, control);
    console.end_progress();
    if (what.format == Format::json) {
        print_report(eval::verify_json(report, file));
    } else if (what.verbosity == Verbosity::normal) {
        print_report(verify_text(report, arguments.options));
    }
    if (const std::optional<int> signal = interrupt.signal()) {
        return 128 + *signal;
    }
    return exit_code(report.verdict);
}

}  // namespace bdpt::app
