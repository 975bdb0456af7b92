#include "options/plan_arguments.h"

#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {
namespace {

constexpr std::int64_t max_parts = 100'000;  // as many as Kubernetes indexes
constexpr double max_minutes = 1e6;          // two years

Choices<Engine> engines()
{
    return {{{"slurm", Engine::slurm}, {"kubernetes", Engine::kubernetes}, {"make", Engine::make}}};
}

/// Returns the given options that plans keep for the command of `use`, as words.
std::vector<std::string> kept_words(const OptionList& options, bool OptionUses::*use)
{
    std::vector<std::string> words;
    for (const Option& option : options.all()) {
        if (option.uses.*use && option.is_harmless() && option.given()) {
            words.push_back(option.word());
        }
    }
    return words;
}

}  // namespace

PlannableOptions plannable_options()
{
    OptionList options;
    PlanRequest request;
    add_plan_options(options, request);
    PlannableOptions result;
    for (const Option& option : options.all()) {
        if (option.uses.plan_render && option.is_harmless()) {
            result.render.push_back(option.name());
        }
        if (option.uses.plan_merge && option.is_harmless()) {
            result.merge.push_back(option.name());
        }
    }
    // Added by `checked`, and chosen for --integrator auto.
    result.render.insert(result.render.end(), {"--env", "--strategy-depth"});
    return result;
}

void add_plan_options(OptionList& options, PlanRequest& request)
{
    PlanArguments& arguments = request.arguments;
    options.section("Plan");
    options.add("--parts", "N",
                "Total number of tasks. Each renders some of the samples of all pixels; with fewer "
                "tasks than frames, each renders some frames",
                arguments.parts, whole_number(1, max_parts));
    options.add("--minutes", "M",
                "Instead of --parts: tasks of about this length on a machine like this one "
                "(--threads), by a test render of some seconds",
                arguments.minutes,
                number_above(0.0, max_minutes, "a number above 0 and up to 1000000"));
    options
        .add("--for", choice_text(engines().words()), "System that starts the tasks",
             arguments.engine, engines().type())
        .required = true;
    options
        .add("-d,--directory", "FOLDER", "Folder of the plan and its parts, created if missing",
             arguments.folder, any_text())
        .required = true;
    options.add_flag("--restart", "Replace an existing plan, and remove the parts of its tasks",
                     arguments.existing,
                     on_or_off(ExistingPlan::replace, ExistingPlan::must_be_equal));
    add_plannable_options(options, request.render);
    add_sequence_options(options, request.render.sequence);
    options.section("Output");
    add_strategy_options(options, request.render.strategies);
}

PlanArguments checked(const PlanRequest& request, const OptionList& options)
{
    PlanArguments result = request.arguments;
    result.render = checked(request.render, options);
    RenderArguments& render = result.render;
    if (render.outputs.empty()) {
        throw OptionError("--output is required");
    }
    if (result.parts.has_value() == options.given("--minutes")) {
        throw OptionError("either --parts or --minutes is required");
    }
    if (render.file == "-" || render.environment == "-" || use_standard_output(render.outputs)) {
        throw OptionError(
            "-: a plan cannot use pipes; name files, which its tasks can read and write");
    }
    if (render.rates && render.sequence) {
        throw OptionError(
            "--adaptive: a plan of several images cannot have rates: each image needs its own");
    }
    if (options.given("--denoiser-library")) {
        throw OptionError(
            "--denoiser-library belongs to bdpt merge --plan: a plan cannot choose code to load");
    }
    result.render_options = kept_words(options, &OptionUses::plan_render);
    if (render.environment && !is_file_of_environment(*render.environment)) {
        result.render_options.push_back("--env=" + *render.environment);
    }
    result.merge_options = kept_words(options, &OptionUses::plan_merge);
    return result;
}

}  // namespace bdpt::job
