#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/scene.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <array>
#include <optional>

#include "commands/commands.h"
#include "options/job_file.h"
#include "options/output_files.h"
#include "options/value_types.h"
#include "report/render_report.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

std::string version_text()
{
    const eval::MachineFacts facts = eval::machine_facts();
    const Isa isa = Scene(SceneDesc{}).isa();
    return fmt::format("bdpt {}\nLibraries: {}\nCompiler: {}\nInstruction set of Embree here: {}",
                       BDPT_VERSION, facts.libraries, facts.compiler, isa_name(isa));
}

namespace {

namespace fs = std::filesystem;

constexpr const char* program_footer = R"(Examples:
  bdpt render model.glb                                        (writes model.png)
  bdpt render scene.glb -o out.exr -o preview.png --spp 256
  bdpt develop out.exr -o bright.png --exposure 2
  bdpt view scene.glb
  bdpt info scene.glb
  bdpt plan scene.glb -o out.exr --spp 4096 --parts 64 --for slurm -d job
  bdpt merge part-*.part.exr -o out.exr
  bdpt compare out.exr reference.exr
  bdpt bench scene.gltf -o bench --quick
  bdpt verify scene.gltf
  bdpt inspect scene.gltf --pixel 640,360

"bdpt help COMMAND", or "bdpt COMMAND --help", has the options of a command.)";

/// Runs `bdpt help` and `bdpt help COMMAND`, like `--help`.
int run_help(Program& program, const std::string& topic)
{
    if (!topic.empty() && program.find(topic) == nullptr) {
        throw Error(ErrorCode::usage, unknown_command(program, topic, "bdpt --help"));
    }
    put_help(help_text(program, topic));
    return 0;
}

/// Runs `bdpt render --save-job`: checks that the options are compatible, as a render would.
int save_job(const RenderRequest& request, const OptionList& options)
{
    RenderArguments arguments = checked(request, options);
    const fs::path& file = request.saved_job;
    FileSet inputs(input_files(arguments));
    inputs.add(named_files(arguments, std::array{file}));
    check_output("--save-job", file, inputs, FileSet(arguments.outputs));
    arguments.job = JobSource{.file = file};
    for (const Option& option : options.all()) {
        if (option.given() && option.uses.stated_in == StatedIn::own_folder) {
            arguments.job->outputs.push_back(option.name());
        }
    }
    check_files_of_job(arguments);
    write_text(file, job_text(options, file));
    TerminalConsole(arguments.printed.format, arguments.printed.verbosity)
        .note(fmt::format("wrote {}", file.string()));
    return 0;
}

/// Renders one scene, controlled by signals. Returns the exit code: 0, or 128 + a signal's number
/// if that ended the render early.
int run_scene(const RenderArguments& arguments, const std::vector<std::string>& words)
{
    TerminalConsole console(arguments.printed.format, arguments.printed.verbosity);
    SignalInterrupt interrupt({}, [&console] {
        console.note("stopping after the current pass; interrupt again to quit at once");
    });
    static_cast<void>(run_render(arguments, words, console, interrupt));
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : 0;
}

/// Runs `bdpt render SCENE...` and `bdpt render JOB`.
int run_render_words(const RenderRequest& request, OptionList& options,
                     const std::vector<std::string>& given)
{
    std::vector<std::string> words = given;
    std::vector<fs::path> scenes{request.arguments.file};
    scenes.insert(scenes.end(), request.others.begin(), request.others.end());
    if (scenes.size() == 1 && is_job(scenes.front())) {
        load_job(scenes.front(), options);
        scenes = {request.arguments.file};
        // With the job's options as words, commands that render missing samples need not name the
        // job.
        words.resize(2);
        const std::vector<std::string> more = to_words(options);
        words.insert(words.end(), more.begin(), more.end());
    }
    if (!request.saved_job.empty() && scenes.size() == 1) {
        return save_job(request, options);
    }
    return run_render_scenes(checked(request, options), scenes, options,
                             [&](const RenderArguments& one) { return run_scene(one, words); });
}

/// Runs `bdpt view SCENE` and `bdpt view JOB`.
int run_view_words(const ViewRequest& request, OptionList& options,
                   const std::vector<std::string>& /*words*/)
{
    if (const fs::path file = request.render.arguments.file; is_job(file)) {
        load_viewed_job(file, options);
    }
    return run_view(checked(request, options), options);
}

}  // namespace

CommandLine::CommandLine()
{
    program.name = "bdpt";
    program.summary = "bdpt renders glTF 2.0 scenes by bidirectional path tracing.";
    program.footer = program_footer;
    program.version = version_text;  // a callback, as it asks Embree, which starts threads
    using Words = std::vector<std::string>;
    // `add_options` adds the options that store into `request`; `run` takes both, and the words.
    const auto add = [this](const char* name, const char* summary, const char* footer,
                            const auto& add_options, auto& request, const auto& run) -> Command& {
        Command& command = program.commands.emplace_back();
        command.name = name;
        command.summary = summary;
        command.footer = footer;
        add_options(command.options, request);
        command.run = [&command, &request, run](const Words& words) {
            return run(request, command.options, words);
        };
        return command;
    };
    // Runs a command with its checked arguments alone.
    const auto checked_by = [](const auto& run) {
        return [run](const auto& request, OptionList& options, const Words& /*words*/) {
            return run(checked(request, options));
        };
    };
    Command& rendering = add("render", "Render a scene to an image", render_footer,
                             add_render_options, render, run_render_words);
    rendering.essentials = render_essentials();
    rendering.short_footer = render_short_footer;
    Command& viewing = add("view", "Preview a scene in the browser, to choose view, light and look",
                           view_footer, add_view_command_options, view, run_view_words);
    viewing.essentials = {{"file"},         {"--spp"},    {"--size"},     {"--camera"},
                          {"--view"},       {"--env"},    {"--exposure"}, {"--integrator"},
                          {"--background"}, {"--listen"}, {"--open"}};
    viewing.short_footer = view_short_footer;
    add("plan", "Distribute a render over processes or machines", plan_footer, add_plan_options,
        plan, checked_by(run_plan));
    add("merge", "Merge separately rendered parts of a render", merge_footer, add_merge_options,
        merge, checked_by(run_merge));
    add("develop", "Convert an .exr file to pictures, without rendering", develop_footer,
        add_develop_options, develop,
        [](const DevelopArguments& arguments, OptionList& options, const Words& /*words*/) {
            check(arguments, options);
            return run_develop(arguments);
        });
    add("info", "Print what a scene contains", info_footer, add_info_options, info,
        [](const InfoArguments& arguments, OptionList& options, const Words& /*words*/) {
            return run_info(arguments, options);
        });
    add("compare", "Measure the error of images against a reference", compare_footer,
        add_compare_options, compare, checked_by(run_compare));
    add("bench", "Compare integrators at equal time and equal samples", bench_footer,
        add_bench_options, bench,
        [](const BenchRequest& request, OptionList& options, const Words& words) {
            return run_bench(checked(request, options), words);
        });
    add("verify", "Test that all integrators and strategies agree on a scene", verify_footer,
        add_verify_options, verify, checked_by(run_verify));
    add("inspect", "Print the paths of one sample of a pixel", inspect_footer, add_inspect_options,
        inspect, checked_by(run_inspect));
    const auto add_topic = [](OptionList& options, std::string& target) {
        options.add("command", "COMMAND", "The command. Default: all", target, any_text());
    };
    add("help", "Print the help of a command", "", add_topic, topic,
        [this](const std::string& asked, OptionList& /*options*/, const Words& /*words*/) {
            return run_help(program, asked);
        });
    add(
        "version", "Print the versions of bdpt and libraries, and the instruction set", "",
        [](OptionList& /*options*/, const std::string& /*none*/) {}, topic,
        [](const std::string& /*none*/, OptionList& /*options*/, const Words& /*words*/) {
            print_text(version_text() + "\n");
            return 0;
        });
}

}  // namespace bdpt::app
