#include "commands/plan_command.h"

#include <bdpt/error.h>
#include <bdpt/eval/bench/option_names.h>
#include <bdpt/integrators.h>
#include <bdpt/isa.h>
#include <bdpt/part/identity.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "options/values/output_files.h"
#include "plan/engines/engine_files.h"
#include "plan/plan.h"
#include "plan/plan_folder.h"
#include "plan/planned_words.h"
#include "plan/sample_split.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// As it is in a plan: relative paths are relative to `folder`, which is absolute.
fs::path planned_path(const fs::path& path, const fs::path& folder)
{
    if (path.is_absolute()) {
        return path;
    }
    return fs::weakly_canonical(fs::absolute(path)).lexically_relative(folder);
}

/// Words that choose by hand what was chosen for `options`.
std::vector<std::string> chosen_words(const RenderOptions& options, Isa isa)
{
    std::vector<std::string> words{
        fmt::format("--isa={}", isa_name(isa)),
        fmt::format("--integrator={}", eval::to_string(options.integrator))};
    if (info(options.integrator).traces_light_paths) {
        words.push_back(fmt::format("--light-paths={}", options.bidirectional.light_paths));
        if (options.bidirectional.connections) {
            words.push_back(fmt::format("--connections={}", *options.bidirectional.connections));
        }
    }
    return words;
}

/// The identity that tasks will find, by what their words say.
Identity identity_of_tasks(const Plan& plan, const fs::path& file, const PreparedScene& stage,
                           Console& console)
{
    CLI::App command;
    RenderWords words;
    add_render_options(command, words);
    std::vector<std::string> shared = shared_words(plan, file);
    shared.push_back("--part=" + plan.tasks.front().part.string());
    std::reverse(shared.begin(), shared.end());  // the parser takes words from the end
    command.parse(std::move(shared));
    return identity(stage.scene, stage.camera,
                    with_choice(understand(words), stage, console).options);
}

/// Number of tasks that take about as long as they may.
std::int64_t measured_parts(const PlanArguments& arguments, RenderOptions options,
                            const PreparedScene& stage, Console& console)
{
    constexpr std::int64_t most_samples = 64;
    constexpr double most_seconds = 10.0;
    constexpr double minute = 60.0;  // [s]
    const SampleRange samples = options.sampling.samples;
    options.sampling.samples.end = std::min(samples.end, samples.begin + most_samples);
    RenderControl control;
    control.time_limit = most_seconds;
    const RenderResult result = render(stage.scene, stage.camera, options, control);
    const auto done = static_cast<double>(result.samples.end - result.samples.begin);
    const double seconds = result.seconds / done;
    const double start = stage.load_seconds + stage.build_seconds;
    console.note(
        fmt::format("a sample of all pixels takes {:.3g} s here, and a task {:.1f} s to "
                    "start",
                    seconds, start));
    return parts_of_time(samples, arguments.minutes * minute, seconds, start);
}

std::vector<PlanTask> tasks_of(SampleRange samples, std::int64_t parts)
{
    std::vector<PlanTask> tasks;
    const std::size_t digits = std::to_string(parts - 1).size();
    for (const SampleRange& range : split_samples(samples, parts)) {
        tasks.push_back(
            {.samples = range, .part = fmt::format("task-{:0{}}.part.exr", tasks.size(), digits)});
    }
    return tasks;
}

void check_files(const PlanArguments& arguments)
{
    std::vector<fs::path> inputs{arguments.render.file};
    if (arguments.render.environment) {
        inputs.emplace_back(*arguments.render.environment);
    }
    check_outputs(arguments.render.outputs, inputs);
    check_plan_folder(arguments.folder);
}

/// All of the plan but its tasks and engine.
Plan plan_of(const PlanArguments& arguments, const fs::path& folder, const RenderOptions& chosen,
             Isa isa)
{
    const RenderArguments& asked = arguments.render;
    Plan plan{.scene = planned_path(asked.file, folder),
              .render_options = arguments.render_options,
              .merge_options = arguments.merge_options};
    if (asked.environment && *asked.environment != "none" && *asked.environment != "default") {
        plan.environment = planned_path(*asked.environment, folder);
    }
    for (const fs::path& output : asked.outputs) {
        plan.outputs.push_back(planned_path(output, folder));
    }
    std::erase_if(plan.render_options, [](const std::string& word) {
        return word.starts_with("--isa=") || word == "--integrator=auto";
    });
    const bool open = asked.options.integrator == IntegratorKind::automatic;
    for (const std::string& word : chosen_words(chosen, isa)) {
        if (open || word.starts_with("--isa=")) {
            plan.render_options.push_back(word);
        }
    }
    return plan;
}

void report_plan(Console& console, const PlanArguments& arguments, const Plan& plan)
{
    const fs::path file = arguments.folder / "plan.json";
    const auto size = [](const PlanTask& task) { return task.samples.end - task.samples.begin; };
    const auto [least, most] =
        std::minmax_element(plan.tasks.begin(), plan.tasks.end(),
                            [&](const auto& a, const auto& b) { return size(a) < size(b); });
    const std::string samples = size(*least) == size(*most)
                                    ? fmt::format("{}", size(*most))
                                    : fmt::format("{} to {}", size(*least), size(*most));
    console.note(fmt::format("wrote {}: {} of {} samples; {}", file.string(),
                             counted(plan.tasks.size(), "task"), samples,
                             start_command(arguments.engine, arguments.folder)));
    console.event("done", {{"plan", file.string()}, {"tasks", plan.tasks.size()}});
}

}  // namespace

int run_plan(const PlanArguments& arguments)
{
    check_files(arguments);
    Console console(arguments.render.format, arguments.render.verbosity);
    const fs::path folder =
        fs::weakly_canonical(fs::absolute(arguments.folder / "plan.json")).parent_path();
    const PreparedScene stage = prepare_within_memory(arguments.render, console);
    console.end_progress();
    for (const std::string& warning : stage.warnings) {
        console.warning(warning);
    }
    const RenderOptions chosen = with_choice(arguments.render, stage, console).options;
    Plan plan = plan_of(arguments, folder, chosen, stage.scene.isa());
    plan.tasks = tasks_of(
        chosen.sampling.samples,
        arguments.parts ? *arguments.parts : measured_parts(arguments, chosen, stage, console));
    plan.identity = identity_of_tasks(plan, folder / "plan.json", stage, console);
    if (const auto what = difference(identity(stage.scene, stage.camera, chosen), plan.identity)) {
        throw Error(ErrorCode::internal,
                    fmt::format("{}: the words of the plan give another render: {}",
                                arguments.render.file.string(), *what));
    }
    const std::vector<EngineFile> files = engine_files(arguments.engine, plan, folder);
    for (const EngineFile& file : files) {
        plan.engine_files.emplace_back(file.name);
    }
    write_plan(arguments.folder, plan, files, arguments.existing);
    report_plan(console, arguments, plan);
    return 0;
}

}  // namespace bdpt::app
