#include "commands/commands.h"

#include <bdpt/eval/verify.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <string>

#include "options/groups/transport_arguments.h"
#include "report/eval_text.h"
#include "stage/prepared_scene.h"
#include "stage/render_preparation.h"
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

namespace {

/// Returns the verification options, with the light paths that auto chooses on request.
eval::VerifyOptions options_for(const VerifyArguments& arguments, const PreparedScene& stage,
                                Console& console)
{
    eval::VerifyOptions options = arguments.options;
    if (arguments.stage.options.integrator != IntegratorKind::automatic) {
        return options;
    }
    RenderOptions asked = arguments.stage.options;
    asked.film.width = options.width;
    asked.film.height = options.height;
    RenderOptions chosen = chosen_options(stage.scene, stage.camera, asked);
    chosen.bidirectional.disabled.clear();  // all strategies are tested
    console.note(fmt::format("auto chooses {}", integrator_words(chosen)));
    if (chosen.integrator == IntegratorKind::bdpt) {
        options.light_paths = chosen.bidirectional.light_paths;
        options.connections = chosen.bidirectional.connections;
        options.connection_rays = chosen.bidirectional.connection_rays;
    }
    return options;
}

}  // namespace

int run_verify(const VerifyArguments& arguments)
{
    const RenderArguments& what = arguments.stage;
    // stdout has the report alone, so all else goes to stderr in both formats.
    TerminalConsole console(Format::text, what.printed.verbosity);
    SignalInterrupt interrupt({}, [&console] {
        console.note("stopping after the current batches; interrupt again to quit at once");
    });
    const PreparedScene stage = prepare_scene(what);
    interrupt.allow_stop();
    const std::string file = what.file.string();
    tell_findings(console, stage);
    console.note(fmt::format("{}: {}; {}x{}, camera {}", file, size_text(stage), stage.size.width,
                             stage.size.height, stage.camera.name));
    const eval::VerifyOptions options = options_for(arguments, stage, console);
    eval::VerifyControl control;
    control.stop = interrupt.stop_token();
    control.on_progress = [&](const eval::VerifyProgress& progress) {
        console.progress({.samples_done = progress.batches * eval::bdpt_samples,
                          .samples_total = 0,
                          .seconds = progress.seconds},
                         {.samples = std::nullopt, .seconds = options.seconds});
    };
    const eval::VerifyReport report = eval::verify(stage.scene, stage.camera, options, control);
    console.end_progress();
    if (what.printed.format == Format::json) {
        print_text(eval::verify_json(report, file));
    } else if (what.printed.verbosity == Verbosity::normal) {
        print_text(verify_text(report, options));
    }
    if (const std::optional<int> signal = interrupt.signal()) {
        return 128 + *signal;
    }
    return exit_code(report.verdict);
}

}  // namespace bdpt::app
