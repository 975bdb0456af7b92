#include <bdpt/error.h>
#include <fmt/core.h>

#include <string>
#include <vector>

#include "callbacks.h"
#include "commands/render_command.h"
#include "commands/render_scenes.h"
#include "job_options.h"
#include "options/job_file.h"
#include "options/values/pipes.h"
#include "terminal/machine_limits.h"

namespace bdpt {
namespace {

/// Throws `Error` (usage) if one of `options` names the standard input or output.
void refuse_streams(const app::OptionList& options)
{
    for (const app::Option& option : options.all()) {
        for (const std::string& text : option.texts) {
            if (option.info.is_path && app::is_standard_output(text)) {
                throw Error(ErrorCode::usage,
                            fmt::format("{} \"{}\": the standard input and output belong to the "
                                        "program that runs the job",
                                        to_key(option), text));
            }
        }
    }
}

}  // namespace

JobResult run(const RenderJob& job, const JobControl& control)
{
    job::JobOptions options(job.settings());
    refuse_streams(options.list());
    options.list().store_given();
    const app::RenderArguments asked = checked(options.request(), options.list());
    std::vector<std::string> words{"bdpt", "render"};
    const std::vector<std::string> more = to_words(options.list());
    words.insert(words.end(), more.begin(), more.end());
    job::CallbackConsole console(control);
    job::TokenInterrupt interrupt(control.stop);
    JobResult result;
    app::within_quota(
        [&] { result = run_render(for_scene(asked, asked.file), words, console, interrupt); });
    return result;
}

}  // namespace bdpt
