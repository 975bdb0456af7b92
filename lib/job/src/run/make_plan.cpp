#include "run/run_render.h"

#include <bdpt/error.h>
#include <bdpt/io/part_file.h>
#include <bdpt/isa.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/console.h"
#include "messages/text.h"
#include "options/output_files.h"
#include "options/value_types.h"
#include "output/render_report.h"
#include "plan/plan.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Returns a path as in a plan: relative paths are relative to `folder`, which is absolute.
fs::path planned_path(const fs::path& path, const fs::path& folder)
{
    if (path.is_absolute()) {
        return path;
    }
    return fs::weakly_canonical(fs::absolute(path)).lexically_relative(folder);
}

/// Returns words that set the options that were chosen automatically for `options`.
std::vector<std::string> chosen_words(const RenderOptions& options, Isa isa)
{
    std::vector<std::string> words{fmt::format("--isa={}", isa_name(isa)),
                                   fmt::format("--integrator={}", to_name(options.integrator))};
    if (info(options.integrator).traces_light_paths) {
        words.push_back(fmt::format("--light-paths={}", options.bidirectional.light_paths));
        if (options.bidirectional.connections) {
            words.push_back(fmt::format("--connections={}", *options.bidirectional.connections));
        }
        if (options.bidirectional.connection_rays > 0.0) {
            words.push_back(
                fmt::format("--connection-rays={}", options.bidirectional.connection_rays));
        }
        if (!options.bidirectional.disabled.empty()) {
            words.push_back(fmt::format("--disable={}", disabled_text(options)));
        }
    }
    return words;
}

/// The words of `asked` with the options chosen for its first image, and that image's identity.
struct FirstImage {
    RenderArguments arguments;
    Identity identity;
};

FirstImage first_image(const RenderArguments& asked, const SequenceView& view,
                       const PreparedScene& stage, Console& console)
{
    const RenderArguments chosen = with_choice(make_view_arguments(asked, view), stage, console);
    return {chosen, identity(stage.scene, stage.camera, chosen.options)};
}

/// Returns the identity that tasks will find for the first image by their words.
Identity identity_of_tasks(Plan plan, const fs::path& file, const PreparedScene& stage,
                           const RenderOptions& chosen, Console& console)
{
    plan.rates.reset();  // their file does not exist yet
    std::vector<std::string> shared = shared_words(plan, file);
    shared.push_back("--part=" + plan.tasks.front().part.string());
    const RenderArguments asked = render_arguments(shared);
    const SequenceView view = make_views(asked, collect_cameras(plan)).front();
    RenderArguments arguments = with_choice(make_view_arguments(asked, view), stage, console);
    arguments.options.sampling.rates = chosen.sampling.rates;
    arguments.options.sampling.samples = chosen.sampling.samples;
    return identity(stage.scene, stage.camera, arguments.options);
}

/// Returns the number whose multiples ranges of samples are. Any image of a sequence may choose
/// rates.
std::int64_t min_samples_of_task(const RenderArguments& asked, const RenderOptions& chosen)
{
    const bool may_choose = asked.sequence.has_value() && asked.may_adapt;
    return chosen.sampling.rates || may_choose ? SampleRates::group : 1;
}

/// Tests whether there are enough samples for tasks of renders with rates.
bool has_samples_for_rates(const PlanArguments& arguments, std::size_t images)
{
    const SampleRange& samples = arguments.render.samples;
    return !arguments.parts ||
           *arguments.parts * SampleRates::group <=
               static_cast<std::int64_t>(images) * (samples.end - samples.begin);
}

/// Returns the number of tasks that take about as long as allowed.
std::int64_t measured_tasks(const PlanArguments& arguments, RenderOptions options,
                            std::size_t images, const PreparedScene& stage, Console& console)
{
    constexpr std::int64_t max_samples = 64;
    constexpr double max_seconds = 10.0;
    constexpr double minute = 60.0;  // [s]
    const SampleRange samples = options.sampling.samples;
    options.sampling.samples.end = std::min(samples.end, samples.begin + max_samples);
    RenderControl control;
    control.time_limit = max_seconds;
    const RenderResult result = render(stage.scene, stage.camera, options, control);
    const auto done = static_cast<double>(result.samples.count());
    const double seconds = result.seconds / done;
    const double start = stage.load_seconds + stage.build_seconds;
    console.note(
        fmt::format("a sample of all pixels takes {:.3g} s here, and a task {:.1f} s to "
                    "start",
                    seconds, start));
    return tasks_of_time(images, samples, arguments.minutes * minute, seconds, start,
                         min_samples_of_task(arguments.render, options));
}

/// Returns the number of tasks. Throws `OptionError` for more than there are samples to render.
std::int64_t number_of_tasks(const PlanArguments& arguments, const RenderOptions& options,
                             std::size_t images, const PreparedScene& stage, Console& console)
{
    if (!arguments.parts) {
        return measured_tasks(arguments, options, images, stage, console);
    }
    const SampleRange samples = options.sampling.samples;
    const std::int64_t all = static_cast<std::int64_t>(images) * (samples.end - samples.begin);
    const std::int64_t least = min_samples_of_task(arguments.render, options);
    if (*arguments.parts > all / least) {
        reject("--parts", fmt::format("{}", *arguments.parts),
               fmt::format("at most one for each {}of the {} samples{}{}",
                           least > 1 ? fmt::format("{} ", least) : "", all,
                           images > 1 ? fmt::format(" of {} images", images) : "",
                           least > 1 ? ", with rates" : ""));
    }
    return *arguments.parts;
}

PlanImage make_plan_image(const RenderArguments& asked, const SequenceView& view)
{
    PlanImage image;
    if (asked.sequence) {
        image.frame = view.frame;
        image.camera = view.camera ? std::optional(view.camera_name) : std::nullopt;
        image.seed = make_view_arguments(asked, view).options.sampling.seed;
    }
    return image;
}

void check_files(const PlanArguments& arguments, const FileSet& inputs)
{
    check_outputs(arguments.render.outputs, inputs);
    if (arguments.render.strategies) {
        check_strategy_files(*arguments.render.strategies, inputs, arguments.render.outputs);
    }
    check_plan_folder(arguments.folder);
}

/// Returns the plan without its images, tasks and engine.
Plan make_plan(const PlanArguments& arguments, const fs::path& folder, const RenderOptions& chosen,
               Isa isa)
{
    const RenderArguments& asked = arguments.render;
    Plan plan{.scene = planned_path(asked.file, folder),
              .render_options = arguments.render_options,
              .merge_options = arguments.merge_options};
    if (asked.environment && is_file_of_environment(*asked.environment)) {
        plan.environment = planned_path(*asked.environment, folder);
    }
    if (asked.volume) {
        plan.volume = planned_path(asked.volume->file, folder);
    }
    for (const fs::path& output : asked.outputs) {
        plan.outputs.push_back(planned_path(output, folder));
    }
    if (asked.strategies) {
        plan.strategies = planned_path(asked.strategies->layers, folder);
        plan.render_options.push_back(
            fmt::format("--strategy-depth={}", chosen.bidirectional.strategy_depth));
    }
    if (chosen.sampling.rates && !asked.sequence) {
        plan.rates = "rates.exr";
    }
    std::erase_if(plan.render_options, [](const std::string& word) {
        return word.starts_with("--isa=") || word == "--integrator=auto" ||
               word.starts_with("--adaptive");
    });
    if (asked.sequence && !asked.may_adapt) {
        plan.render_options.emplace_back("--adaptive=false");
    }
    // Images of a sequence choose options individually, as without a plan.
    const bool pinned =
        asked.options.integrator == IntegratorKind::automatic && !asked.sequence.has_value();
    for (const std::string& word : chosen_words(chosen, isa)) {
        if (pinned || word.starts_with("--isa=")) {
            plan.render_options.push_back(word);
        }
    }
    return plan;
}

/// Returns the files to write into the folder.
std::vector<fs::path> files_of_plan(const fs::path& folder, const Plan& plan)
{
    std::vector<fs::path> files{folder / "plan.json"};
    for (const fs::path& file : plan.engine_files) {
        files.push_back(folder / file);
    }
    if (plan.rates) {
        files.push_back(folder / *plan.rates);
    }
    return files;
}

/// Loads the scene with the view of the first image.
PreparedScene load_first_image(const RenderArguments& asked, Console& console)
{
    RenderArguments one = asked;
    if (one.sequence) {
        one.sequence->cameras = SequenceCameras::one;
    }
    const SequenceView frame = make_views(one, {}).front();
    PreparedScene stage = prepare_with_progress(make_view_arguments(one, frame), console);
    console.end_progress();
    const SequenceView view = make_views(asked, camera_names(stage)).front();
    Viewpoint seen = sequence_viewpoint(stage, {stage.camera, stage.size, stage.is_framed},
                                        make_view_arguments(asked, view));
    stage.camera = std::move(seen.camera);
    stage.size = seen.size;
    return stage;
}

/// Returns " of 4 images" for the images of a task, if the plan has several images.
std::string images_of_tasks(const Plan& plan)
{
    if (plan.images.size() == 1) {
        return "";
    }
    const auto [least, most] =
        std::minmax_element(plan.tasks.begin(), plan.tasks.end(),
                            [](const auto& a, const auto& b) { return a.images < b.images; });
    return least->images == most->images
               ? fmt::format(" of {}", counted(most->images, "image"))
               : fmt::format(" of {} to {}", least->images, counted(most->images, "image"));
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
    console.note(fmt::format("wrote {}: {} of {} samples{}; {}", file.string(),
                             counted(plan.tasks.size(), "task"), samples, images_of_tasks(plan),
                             start_command(arguments.engine, arguments.folder)));
    console.event("done", {{"plan", file.string()}, {"tasks", plan.tasks.size()}});
}

/// Fills in the identity of the plan's images: complete for a single image. Throws `Error`
/// (internal) if the plan's words would make another image.
void identify(Plan& plan, const fs::path& file, const FirstImage& first,
              const RenderArguments& asked, const PreparedScene& stage, Console& console)
{
    const Identity of_tasks =
        identity_of_tasks(plan, file, stage, first.arguments.options, console);
    if (const auto what = difference(first.identity, of_tasks)) {
        throw Error(ErrorCode::internal,
                    fmt::format("{}: the options of the plan give another render: {}",
                                asked.file.string(), *what));
    }
    plan.identity = asked.sequence ? common_identity(of_tasks, asked) : of_tasks;
    if (asked.sequence) {
        plan.files = identity_of_files(asked);
    }
}

}  // namespace

void make_plan(const PlanArguments& given, Console& console)
{
    PlanArguments arguments = given;
    RenderArguments& asked = arguments.render;
    check_patterns(asked);
    if (asked.display.backdrop && !asked.display.backdrop->photo.empty()) {
        throw OptionError(
            fmt::format("--background \"{}\": a plan cannot contain a photograph: use --background "
                        "transparent, and give the photograph to bdpt merge",
                        backdrop_text(*asked.display.backdrop)));
    }
    std::vector<EngineFile> templates = engine_templates(arguments.engine, arguments.templates);
    check_files(arguments, input_files(asked));
    const fs::path folder =
        fs::weakly_canonical(fs::absolute(arguments.folder / "plan.json")).parent_path();
    if (const std::optional<std::string> warning = warning_of_flicker(asked, FramesBy::tasks)) {
        console.warning(*warning);
    }
    const PreparedScene stage = load_first_image(asked, console);
    FileSet inputs = input_files(asked, stage);
    inputs.add(arguments.templates);
    check_files(arguments, inputs);
    tell_findings(console, stage);
    const std::vector<SequenceView> views = make_views(asked, camera_names(stage));
    asked.may_adapt = asked.may_adapt && has_samples_for_rates(arguments, views.size());
    const FirstImage first = first_image(asked, views.front(), stage, console);
    const RenderOptions& options = first.arguments.options;
    Plan plan = make_plan(arguments, folder, options, stage.scene.isa());
    plan.images.clear();
    for (const SequenceView& view : views) {
        plan.images.push_back(make_plan_image(asked, view));
    }
    plan.tasks = split_plan(plan, options.sampling.samples,
                            number_of_tasks(arguments, options, views.size(), stage, console),
                            min_samples_of_task(asked, options));
    identify(plan, folder / "plan.json", first, asked, stage, console);
    const std::vector<EngineFile> files = engine_files(std::move(templates), plan, folder);
    for (const EngineFile& file : files) {
        plan.engine_files.emplace_back(file.name);
    }
    check_not_read(files_of_plan(arguments.folder, plan), inputs);
    write_plan(
        arguments.folder, plan, files,
        [&](const fs::path& file) { io::write_rates(file, *options.sampling.rates, {}); },
        arguments.existing);
    report_plan(console, arguments, plan);
}

}  // namespace bdpt::job
