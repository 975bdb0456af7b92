// Options of plans and merges.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "options/output_files.h"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

/// Parses a time [s]; infinite without a text.
std::optional<double> parse_wait(const std::string& text)
{
    return text == "true" ? std::numeric_limits<double>::infinity() : parse_duration(text);
}

}  // namespace

bool is_part_name(const std::filesystem::path& file)
{
    return has_extension(file, ".exr") && has_extension(file.stem(), ".part");
}

void add_merge_options(OptionList& options, MergeArguments& arguments)
{
    options.add_repeated("part", "PART",
                         "Parts of a render, made by bdpt render --part. Required without --plan",
                         arguments.parts, any_text());
    options.section("Output");
    options
        .add_repeated(
            "-o,--output", "FILE",
            "Required: .part.exr (a part again), .exr or .hdr (linear radiance), .png, .jpg or "
            ".webp (tone-mapped); exr:-, png:- etc. write to standard output. May be repeated",
            arguments.outputs, any_text())
        .required = true;
    options.section("Parts");
    options.add("--plan", "FILE",
                "Merge the parts of this plan (bdpt plan); without -o, into the plan's outputs. "
                "Parts need not be given",
                arguments.plan, any_text());
    options.add_flag("--wait",
                     "Wait for missing or incomplete parts until all samples are there; "
                     "--wait=90s, 30m or 2h limits the wait",
                     arguments.wait, parsed_by(parse_wait, "a time like 90s, 30m or 2h"));
    options.section("Output");
    options.add_flag("--partial",
                     "Write the image even if samples are missing: it has more noise, but is "
                     "otherwise correct",
                     arguments.incomplete, on_or_off(Incomplete::write, Incomplete::refuse));
    options.add("--spp", "N",
                "Samples per pixel of the complete render. Default: as stored in the parts",
                arguments.samples, whole_number(1, std::int64_t{1} << 31));
    options.add("--noise", "N%",
                "Print how many more samples reduce the noise to this, like 2%, and the command "
                "that renders them",
                arguments.noise, noise_level());
    add_strategy_file_option(options, arguments.strategies,
                             "Write the strategy images stored in the parts, and their contact "
                             "sheet, as bdpt render --strategies does");
    add_display_options(options, arguments.display);
    add_denoise_options(options, arguments.denoise);
    add_half_option(options, arguments.exr);
    add_tiled_option(options, arguments.exr);
    add_quiet_option(options, arguments.printed);
    add_json_option(options, arguments.printed,
                    "Print one JSON object per line on stdout: warning, done, error. With --quiet "
                    "only done and error");
}

MergeArguments checked(const MergeArguments& arguments, const OptionList& options)
{
    static constexpr std::array conflicts{
        Conflict{"--spp", "--plan", "the plan sets the number of samples"}};
    if (!arguments.plan && arguments.parts.empty()) {
        throw OptionError("part is required");
    }
    check(conflicts, options);
    check_pipes({}, arguments.outputs, arguments.printed.format);
    return arguments;
}

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
    options.add_repeated("--template", "FILE",
                         "A file of --for, like tasks.sbatch, to be filled in and written in place "
                         "of ours of that name. Repeatable",
                         arguments.templates, file_path());
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
