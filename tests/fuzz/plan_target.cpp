#include <bdpt/io/denoise.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "fuzz_target.h"
#include "input_file.h"
#include "options/render_arguments.h"
#include "parser/command_parser.h"
#include "plan/plan.h"
#include "promises.h"

using namespace bdpt;
using namespace bdpt::app;

namespace {

/// Parses `typed`, a command line of one command, and the words of its plan into `options`.
void parse_with_plan(OptionList& options, const std::vector<std::string>& typed)
{
    const std::vector<std::string> words = with_planned_words(typed);
    parse(options, {words.begin() + 2, words.end()});
}

bool is_in(const std::filesystem::path& file, const std::filesystem::path& folder)
{
    return std::filesystem::weakly_canonical(file).parent_path() ==
           std::filesystem::weakly_canonical(folder);
}

/// A task writes its part, and nothing else.
void check_render(const std::string& file)
{
    RenderRequest request;
    OptionList options;
    add_render_options(options, request);
    parse_with_plan(options, {"bdpt", "render", "--plan", file, "--task", "0"});
    const RenderArguments asked = checked(request, options);
    fuzz::promise(asked.outputs.empty() && !asked.stats && !asked.viewer,
                  "a task writes no files that its plan names");
    fuzz::promise(!asked.denoise.library, "a plan loads no code");
    fuzz::promise(!asked.part || is_in(asked.part->file, std::filesystem::path(file).parent_path()),
                  "a task writes into the folder of its plan");
}

void check_merge(const std::string& file)
{
    MergeArguments request;
    OptionList options;
    add_merge_options(options, request);
    parse_with_plan(options, {"bdpt", "merge", "--plan", file});
    const MergeArguments asked = checked(request, options);
    fuzz::promise(!asked.denoise.library, "a plan loads no code");
}

/// What is understood is written in the same words, and all that is asked of a plan has an answer.
void check_plan(const std::string& file)
{
    const Plan plan = read_plan(file);
    const std::string text = to_text(plan);
    const fuzz::InputFile written;
    const auto again =
        written.write(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    fuzz::promise(read_plan(again) == plan, "a plan is read as written", text);
    const SampleSet samples = collect_samples(plan);
    std::size_t parts = 0;
    for (const auto& of_image : parts_by_image(plan)) {
        parts += of_image.size();
        for (const std::filesystem::path& part : of_image) {
            fuzz::promise(part.filename() == part, "parts are in the folder of their plan");
        }
    }
    fuzz::promise(parts <= max_planned_parts, "plans have a largest size");
    const std::vector<SampleSet> missing(plan.images.size(), samples);
    fuzz::promise(tasks_for(plan, missing).size() <= plan.tasks.size(),
                  "tasks are those of the plan");
}

template <typename Check>
void attempt(const Check& check)
{
    try {
        check();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::usage) {  // words that an option does not take
            fuzz::check_refusal(error);
        }
    }
}

}  // namespace

/// Plans of renders, and the command lines that they are filled into.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::InputFile input;
    const std::string file = input.write(data, size).string();
    attempt([&] { check_plan(file); });
    attempt([&] { check_render(file); });
    attempt([&] { check_merge(file); });
    return 0;
}
