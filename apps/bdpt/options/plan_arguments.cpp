#include "options/plan_arguments.h"

#include <bdpt/part/sample_rates.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "options/arguments.h"
#include "options/command_options.h"
#include "options/values/pipes.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr const char* plan_examples = R"(Examples:
  bdpt plan scene.glb -o out.exr --spp 4096 --parts 64 --for slurm -d job
  bdpt plan scene.glb -o out.exr --spp 4096 --minutes 20 --for make -d job
  bdpt plan walk.glb -o out.####.exr --frames 1:48 --fps 24 --parts 12 --for make -d job
  make -C job -j4 -k

The folder of -d gets plan.json and the files of the engine that starts the tasks; their first lines
say how. A task is bdpt render --plan job/plan.json --task 3, and bdpt merge --plan job/plan.json
makes the images. What --integrator auto chooses and the instruction set of this machine are part of
the plan, and so is what --adaptive finds out (rates.exr); each task makes sure that it finds the
scene that was planned. Paths that are given as
relative ones are kept relative to the plan, for machines that have the same folders elsewhere.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 input not found, 4 invalid input,
5 unsupported feature, 6 output cannot be written (also: the folder has another plan), 7 out of
memory.)";

constexpr std::int64_t most_parts = 100'000;  // as many as Kubernetes indexes
constexpr double most_minutes = 1e6;          // two years

constexpr std::array<std::pair<const char*, Engine>, 5> engines{{{"slurm", Engine::slurm},
                                                                 {"kubernetes", Engine::kubernetes},
                                                                 {"make", Engine::make},
                                                                 {"opencue", Engine::opencue},
                                                                 {"aws-batch", Engine::aws_batch}}};

std::vector<std::string> engine_names()
{
    std::vector<std::string> names;
    for (const auto& [name, engine] : engines) {
        names.emplace_back(name);
    }
    return names;
}

/// The one of that name, which the parser has found.
Engine to_engine(std::string_view name)
{
    return std::find_if(engines.begin(), engines.end(),
                        [&](const auto& entry) { return entry.first == name; })
        ->second;
}

// Groups of options that plans have for bdpt render and bdpt merge, and what of them they have not:
// what names files, what a plan says in another way, and what concerns one process.
constexpr std::array render_groups{"How to render", "Film", "What to render", sequence_group};
constexpr std::array merge_groups{"Output"};
constexpr std::array<std::string_view, 7> not_for_render{
    "--env", "--volume", "--rates", "--adaptive", "--spp", "--samples", "--threads"};
constexpr std::array<std::string_view, 7> not_for_merge{
    "--output",         "--quiet",           "--json", "--float", "--strategies",
    "--strategy-depth", "--denoiser-library"};

/// `words` but for what says one of `names`, as "--threads".
template <typename Names>
std::vector<std::string> without(std::vector<std::string> words, const Names& names)
{
    std::erase_if(words, [&](const std::string& word) {
        const std::string name = word.substr(0, word.find('='));
        return std::find(names.begin(), names.end(), name) != names.end();
    });
    return words;
}

/// What `words_of(group)` gives for each of `groups`, but for `names`.
template <typename Groups, typename Names, typename WordsOf>
std::vector<std::string> words_of_groups(const Groups& groups, const Names& names,
                                         const WordsOf& words_of)
{
    std::vector<std::string> words;
    for (const char* group : groups) {
        for (std::string& word : words_of(group)) {
            words.push_back(std::move(word));
        }
    }
    return without(std::move(words), names);
}

bool names_no_file(const std::optional<std::string>& environment)
{
    return environment == "none" || environment == "default";
}

void check_parts(const PlanWords& words)
{
    if (words.parts.has_value() == words.minutes.has_value()) {
        throw OptionError("--parts: expected either it or --minutes");
    }
    // AWS Batch has no arrays of one task, and none of more than 10,000.
    constexpr std::int64_t longest_array = 10'000;
    if (words.engine == "aws-batch" && words.parts &&
        (*words.parts < 2 || *words.parts > longest_array)) {
        reject("--parts", fmt::format("{}", *words.parts), "2 to 10000 for aws-batch");
    }
}

}  // namespace

PlannableOptions plannable_options()
{
    CLI::App command;
    PlanWords words;
    add_plan_options(command, words);
    const auto names = [&](const char* group) { return option_names(command, group); };
    PlannableOptions result{.render = words_of_groups(render_groups, not_for_render, names),
                            .merge = words_of_groups(merge_groups, not_for_merge, names)};
    // And what `understand` and what is chosen for --integrator auto add.
    for (const char* name : {"--env", "--background", "--denoise", "--strategy-depth"}) {
        result.render.emplace_back(name);
    }
    return result;
}

void add_plan_options(CLI::App& command, PlanWords& words)
{
    words.command = &command;
    const auto group = "Plan";
    command
        .add_option(
            "--parts", words.parts,
            "Number of tasks in all. Each makes a part of the samples of all pixels; of fewer "
            "tasks than frames each makes some frames")
        ->check(whole_number(1, most_parts))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--minutes", words.minutes,
                    "In place of --parts: as many tasks as take about so long on a machine like "
                    "this one (--threads). Renders for some seconds to find out")
        ->check(number(0.0, most_minutes))
        ->type_name("M")
        ->group(group);
    const std::vector<std::string> names = engine_names();
    command.add_option("--for", words.engine, "What starts the tasks")
        ->required()
        ->check(one_of(names))
        ->type_name(fmt::format("{}", fmt::join(names, "|")))
        ->group(group);
    command
        .add_option("-d,--directory", words.folder,
                    "Folder of the plan, and of the parts. It is made if it is not there")
        ->required()
        ->type_name("FOLDER")
        ->group(group);
    command
        .add_flag("--restart", words.restart,
                  "Replace the plan that is there, and remove the parts that its tasks have made")
        ->group(group);
    add_plannable_options(command, words.render);
    add_sequence_options(command, words.render.sequence);
    add_strategy_options(command, words.render.strategies);
    command.footer(plan_examples);
}

PlanArguments understand(const PlanWords& words)
{
    PlanArguments result;
    result.render = understand(words.render);
    if (words.render.outputs.empty()) {
        throw OptionError("--output is required");
    }
    check_parts(words);
    if (result.render.file == "-" || result.render.environment == "-" ||
        use_standard_output(result.render.outputs)) {
        throw OptionError("-: a plan names files, which its tasks can read and write");
    }
    if (result.render.rates && result.render.sequence) {
        throw OptionError(
            "--adaptive: a plan of several images has no rates: each would need its own");
    }
    if (words.render.denoise.library) {
        reject("--denoiser-library", *words.render.denoise.library,
               "it beside bdpt merge --plan: a plan does not say what code is loaded");
    }
    if (words.minutes && !(*words.minutes > 0.0)) {
        reject("--minutes", fmt::format("{}", *words.minutes), "a number above 0");
    }
    const auto given = [&](const char* group) { return given_options(*words.command, group); };
    result.render_options = words_of_groups(render_groups, not_for_render, given);
    if (names_no_file(words.render.environment)) {
        result.render_options.push_back("--env=" + *words.render.environment);
    }
    if (words.render.display.background) {  // of which merging needs alpha
        result.render_options.push_back("--background=" + *words.render.display.background);
    }
    if (result.render.denoise) {
        result.render_options.emplace_back("--denoise");  // for the layers that merging needs
    }
    result.merge_options = words_of_groups(merge_groups, not_for_merge, given);
    result.parts = words.parts;
    result.minutes = words.minutes.value_or(0.0);
    result.engine = to_engine(words.engine);
    result.folder = words.folder;
    result.existing = words.restart ? ExistingPlan::replace : ExistingPlan::must_be_equal;
    return result;
}

}  // namespace bdpt::app
