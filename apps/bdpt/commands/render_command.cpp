#include "commands/commands.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "dataset/dataset.h"
#include "messages/text.h"
#include "options/option_list.h"
#include "options/output_files.h"
#include "output/render_report.h"
#include "parser/command_parser.h"
#include "run/run_render.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* render_footer = R"(Examples:
  bdpt render model.glb
  bdpt render scene.gltf -o out.exr
  bdpt render scene.glb -o out.exr -o out.png --spp 256 --size 1920x1080
  bdpt render *.glb -o 'out/{name}.png'
  bdpt render room.glb -o out.exr --time 90s --camera "Camera 2"
  bdpt render chair.glb -o out.png --background transparent --ground shadow
  bdpt render walk.glb -o out.png --animation run --frame-time 0.25
  bdpt render hall.glb -o out.exr --spp 4096 --part out.part.exr
  bdpt render lamp.glb -o lamp.exr --spp 1024 --adaptive
  bdpt render walk.glb -o walk.####.exr --frames 1:48 --fps 24
  bdpt render hall.glb -o out.png --volume smoke.vdb --volume-extinction 20
  bdpt render model.glb -o out.png --env sky.hdr --from 3,2,4 --look-at 0,1,0 --fov 40

Without a camera in the file, the whole scene is framed; without light, a key and a rim light are
added (in a room a soft sky, in a closed one a lamp); a note says so. Ctrl-C, or closing the
terminal, finishes the current pass and writes the image; a second Ctrl-C quits at once. With
--part, SIGUSR1 writes a checkpoint, and a killed render resumes when the same command runs again.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 input not found, 4 invalid input,
5 unsupported feature, 6 output cannot be written, 7 out of memory or threads, 129 stopped by
SIGHUP, 130 by SIGINT, 143 by SIGTERM.)";

constexpr const char* render_short_footer = R"(Examples:
  bdpt render model.glb
  bdpt render scene.glb -o out.exr -o out.png --time 60s --size 1920x1080
  bdpt render chair.glb -o chair.png --background transparent --ground shadow
  bdpt render model.glb -o out.png --env sky.hdr --from 3,2,4 --look-at 0,1,0 --fov 40

"bdpt render --help-all" has all options, more examples and the exit codes.)";

std::vector<Essential> render_essentials()
{
    return {
        {"file"},
        {"others", "More scenes; {name} in output names becomes the scene's name"},
        {"--output",
         "An image: .png, .jpg or .webp (tone-mapped), .exr or .hdr (linear). May be repeated. "
         "Default: the scene's name with .png"},
        {"--exposure",
         "Exposure: metered from the image (auto), from the incident light (light), or fixed"},
        {"--background",
         "Shown instead of the environment, which still lights the scene: transparent, a colour or "
         "a photograph"},
        {"--denoise",
         "Denoise the image with Open Image Denoise 2. Default: .png, .jpg and .webp, if it is "
         "found; --denoise=false: none"},
        {"--spp"},
        {"--size", "Image size. Default: the largest within 1280x720"},
        {"--time", "Time of loading and rendering, like 90s, 2m or 1.5h"},
        {"--noise", "Stop at this noise, like 2%"},
        {"--ground", "shadow: shadow catcher, an invisible ground below the scene"},
        {"--camera"},
        {"--view",
         "Frame the whole scene: front, right, back, left, top, bottom, three-quarter, or angles "
         "[degrees]"},
        {"--from"},
        {"--look-at"},
        {"--fov"},
        {"--env",
         "Environment map: an equirectangular image, none, default (a soft sky), object (a key and "
         "a rim light) or studio (soft boxes)"},
        {"--orbit", "Turntable: N views, into files with #### in their names"},
    };
}

void check_scenes(const std::vector<fs::path>& scenes, const OptionList& options)
{
    if (scenes.size() < 2) {
        return;
    }
    for (const char* option : {"--part", "--plan", "--strategies", "--save-rates", "--save-job"}) {
        if (options.given(option)) {
            throw OptionError(fmt::format("{} is for one scene, not for several", option));
        }
    }
    for (const fs::path& scene : scenes) {
        check_scene_word(scene.string(), options);
        if (scene == "-" || is_job(scene)) {
            throw OptionError(
                fmt::format("{}: only scene files can be rendered together", scene.string()));
        }
    }
}

/// Throws `OptionError` if two scenes would write the same file, and `Error` (usage) if one would
/// write a file that is read for another.
void check_separate(const std::vector<RenderArguments>& all)
{
    std::vector<fs::path> files;
    for (const RenderArguments& one : all) {
        files.insert(files.end(), one.outputs.begin(), one.outputs.end());
        if (one.stats) {
            files.push_back(*one.stats);
        }
    }
    FileSet inputs;
    for (const RenderArguments& one : all) {
        inputs.add(input_files(one));
        inputs.add(named_files(one, files));
    }
    check_not_read(files, inputs);
    FileSet written;
    for (const fs::path& file : files) {
        if (!written.add(file)) {
            throw OptionError(fmt::format(
                "{}: several scenes would write it: put {{name}} into names of outputs, like "
                "-o '{{name}}.png', and rename scenes of the same name",
                file.string()));
        }
    }
}

/// Renders one scene, controlled by signals. Returns the exit code: 0, or 128 + a signal's number
/// if that ended the render early.
int run_scene(const RenderArguments& arguments, const std::vector<std::string>& words)
{
    TerminalConsole console(arguments.printed.format, arguments.printed.verbosity);
    SignalInterrupt interrupt({}, [&console] {
        console.note("stopping after the current pass; interrupt again to quit at once");
    });
    static_cast<void>(job::run_render(arguments, words, console, interrupt));
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : 0;
}

/// Renders `asked` for each of `scenes`. `words` are the whole command line.
int run_scenes(const RenderArguments& asked, const std::vector<fs::path>& scenes,
               const OptionList& options, const std::vector<std::string>& words)
{
    check_scenes(scenes, options);
    std::vector<RenderArguments> all;
    for (const fs::path& scene : scenes) {
        all.push_back(for_scene(asked, scene));
    }
    if (all.size() == 1) {
        return run_scene(all.front(), words);
    }
    check_separate(all);
    int first_failure = 0;
    std::size_t failures = 0;
    const auto fail = [&](int code, const std::string& message) {
        report_error(asked.printed.format, code, message);
        first_failure = failures++ == 0 ? code : first_failure;
    };
    for (const RenderArguments& one : all) {
        try {
            const int code = run_scene(one, words);
            if (code != 0) {
                return code;  // a signal stopped it
            }
        } catch (const Error& error) {
            const std::string message = error.what();
            const std::string file = one.file.string();
            fail(static_cast<int>(error.code()), message.find(file) != std::string::npos
                                                     ? message
                                                     : fmt::format("{}: {}", file, message));
        } catch (const std::bad_alloc&) {
            fail(static_cast<int>(ErrorCode::out_of_memory),
                 fmt::format("{}: out of memory", one.file.string()));
        }
    }
    if (failures > 0) {
        TerminalConsole(asked.printed.format, asked.printed.verbosity)
            .note(fmt::format("{} of {} failed", failures, counted(all.size(), "scene")));
    }
    return first_failure;
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

int run_render_command(const RenderRequest& request, OptionList& options, const Words& given)
{
    Words words = given;
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
    return run_scenes(checked(request, options), scenes, options, words);
}

}  // namespace

void add_render_command(Program& program)
{
    Command& command =
        add_command<RenderRequest>(program, "render", "Render a scene to an image", render_footer,
                                   add_render_options, run_render_command);
    command.essentials = render_essentials();
    command.short_footer = render_short_footer;
}

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
    const int code = job::run_dataset(arguments, console, interrupt,
                                      [&printed](int exit_code, const std::string& message) {
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
