#include "commands/commands.h"

#include <bdpt/eval/verify.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <string>

#include "options/groups/transport_arguments.h"
#include "report/reports.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

/// Arguments of `bdpt verify`.
struct VerifyArguments {
    RenderArguments stage{};  ///< scene and view
    eval::VerifyOptions options{};
};

/// Options of `bdpt verify`, as given.
struct VerifyRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    eval::VerifyOptions options{};
};

void add_how(OptionList& options, VerifyRequest& request)
{
    RenderRequest& render = request.render;
    RenderOptions& render_options = render.arguments.options;
    options.section("How to verify");
    add_time_option(options, render,
                    "Maximum render time, like 90s, 2m or 1.5h; verify stops earlier if possible. "
                    "Default: 2m");
    add_size_option(options, render, "Image size. Default: 32x32");
    options.add("--max-depth", "N", "Maximum path length tested, in edges. Default: 5",
                request.options.max_depth, whole_number(1, 64));
    options.add("--grid", "N", "Tiles along each side of the image. Default: 4",
                request.options.grid, whole_number(1, 64));
    options.add("--bias", "PERCENT",
                "Smallest error of a strategy that must be detected, as a change of the image mean "
                "[%]. Default: 1",
                request.options.detectable_bias, job::percent(100.0));
    options.add("--false-alarm", "PERCENT",
                "Probability that a correct renderer fails [%]. Default: 0.1",
                request.options.false_alarm, job::percent(50.0));
    const Choices<IntegratorKind> integrators{{{"bdpt", IntegratorKind::bdpt},
                                               {"auto", IntegratorKind::automatic},
                                               {"vcm", IntegratorKind::vcm}}};
    add_choice(options, "--integrator",
               "What is verified: bdpt (default); auto: bdpt with the light paths and connections "
               "that auto chooses; or vcm: bdpt and the image of vcm, which is correct if "
               "--merge-radius is small enough",
               render_options.integrator, integrators);
    add_fields(options, render_options,
               std::array<std::string_view, 7>{"seed", "threads", "light_paths", "connections",
                                               "connection_rays", "merge_radius", "light_samples"});
}

constexpr const char* verify_footer = R"(Examples:
  bdpt verify scene.gltf
  bdpt verify room.glb --from 0,1.6,2 --look-at 0,1,0 --time 10m
  bdpt verify scene.gltf --size 64x64 --max-depth 8 --json
  bdpt verify scene.gltf --light-paths 0.25 --connections 2
  bdpt verify scene.gltf --light-samples 4
  bdpt verify scene.gltf --integrator vcm --merge-radius 0.01

Renders the scene with pt, nee, mis, lt, bdpt and every strategy of bdpt, at low resolution and with
many independent samples, and tests whether they agree: for each path length, in the whole image and
in tiles. docs/verify.md explains the method and the numbers.

Exit codes: 0 pass, 10 fail: something disagrees, 11 inconclusive: nothing disagrees, but the noise
could hide it (use more --time); 1 internal error, 2 wrong usage, 3 input not found, 4 invalid
input, 5 unsupported feature, 6 output cannot be written, 7 out of memory or threads, 129 stopped by
SIGHUP, 130 by SIGINT, 143 by SIGTERM.)";

void add_verify_options(OptionList& options, VerifyRequest& request)
{
    RenderArguments& render = request.render.arguments;
    render.options.integrator = IntegratorKind::bdpt;
    render.options.bidirectional.merge_radius = eval::VerifyOptions::small_merge_radius;
    add_scene_file(options, request.render);
    add_how(options, request);
    add_view_options(options, request.render);
    options.section("Output");
    add_json_option(options, render.printed, "Print one JSON object on stdout instead of text");
    add_quiet_option(options, render.printed, "Print only errors and the object of --json");
}

VerifyArguments checked(const VerifyRequest& request, const OptionList& options)
{
    constexpr int widest = 4096;
    if (request.render.arguments.options.bidirectional.light_paths == 0.0) {
        throw OptionError("--light-paths must be above 0: without light paths there is only mis");
    }
    VerifyArguments result{.stage = checked(request.render, options), .options = request.options};
    eval::VerifyOptions& verify = result.options;
    if (const std::optional<Size>& size = result.stage.size) {
        if (std::max(size->width, size->height) > widest) {
            options.reject_value("--size", "WIDTHxHEIGHT from 1x1 to 4096x4096");
        }
        verify.width = size->width;
        verify.height = size->height;
    }
    result.stage.size = Size{.width = verify.width, .height = verify.height};
    verify.grid = std::min({verify.grid, verify.width, verify.height});
    if (request.render.seconds) {
        verify.seconds = result.stage.goal.seconds;
    }
    const RenderOptions& render = result.stage.options;
    verify.light_paths = render.bidirectional.light_paths;
    verify.connections = render.bidirectional.connections;
    verify.connection_rays = render.bidirectional.connection_rays;
    if (render.integrator == IntegratorKind::vcm) {
        verify.merge_radius = render.bidirectional.merge_radius;
    }
    verify.light_samples = render.sampling.light_samples;
    verify.seed = render.sampling.seed;
    verify.threads = render.system.threads;
    return result;
}

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

}  // namespace

int exit_code(eval::Verdict verdict)
{
    return verdict == eval::Verdict::pass ? 0 : verdict == eval::Verdict::fail ? 10 : 11;
}

void add_verify_command(Program& program)
{
    add_command<VerifyRequest>(program, "verify",
                               "Test that all integrators and strategies agree on a scene",
                               verify_footer, add_verify_options, checked_by(run_verify));
}

}  // namespace bdpt::app
