#include "commands/render_scenes.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "options/foreign_words.h"
#include "options/job_file.h"
#include "options/values/default_output.h"
#include "options/values/file_pattern.h"
#include "options/values/file_set.h"
#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

RenderArguments for_scene(const RenderArguments& asked, const fs::path& scene)
{
    RenderArguments one = asked;
    one.file = scene;
    const std::string name = scene.stem().string();
    for (fs::path& output : one.outputs) {
        output = with_scene(output, name);
    }
    if (one.stats) {
        one.stats = with_scene(*one.stats, name);
    }
    if (one.outputs.empty() && !one.part && !one.sequence && scene != "-") {
        one.outputs.push_back(default_output(scene));
        if (one.job) {
            one.job->names_default = true;
        }
    }
    return one;
}

int run_render_scenes(const RenderArguments& asked, const std::vector<fs::path>& scenes,
                      const OptionList& options, const RenderScene& render)
{
    check_scenes(scenes, options);
    std::vector<RenderArguments> all;
    for (const fs::path& scene : scenes) {
        all.push_back(for_scene(asked, scene));
    }
    if (all.size() == 1) {
        return render(all.front());
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
            const int code = render(one);
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

}  // namespace bdpt::app
