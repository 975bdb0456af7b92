#include "run/run_render.h"

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options/output_files.h"
#include "output/image_files.h"
#include "output/render_report.h"
#include "plan/plan.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {

namespace {

using nlohmann::ordered_json;

/// Reports a task that had been completed before.
void report_complete(Console& console, const RenderArguments& arguments)
{
    const std::int64_t samples = arguments.samples.end - arguments.samples.begin;
    console.note(fmt::format("{}: has all samples of the task", arguments.part->file.string()));
    console.event("done", {{"samples", samples},
                           {"seconds", 0.0},
                           {"outputs", ordered_json::array()},
                           {"exposure", nullptr},
                           {"stopped_by", nullptr}});
}

JobImage complete_image(const RenderArguments& arguments)
{
    const ImageLabel label = make_label(arguments);
    return {.frame = label.frame,
            .camera = label.camera,
            .samples_per_pixel = arguments.samples.end - arguments.samples.begin};
}

PreparedScene load(const RenderArguments& arguments, Console& console)
{
    PreparedScene stage = prepare_within_memory(arguments, console);
    console.end_progress();
    return stage;
}

/// Returns the plan of a task, if any.
std::optional<Plan> read_task_plan(const RenderArguments& asked)
{
    return asked.part && asked.part->plan ? std::optional(read_plan(*asked.part->plan))
                                          : std::nullopt;
}

/// Images that this process renders.
struct Assignment {
    std::vector<SequenceView> views;
    std::size_t first_image = 0;  ///< index in the plan, if there is one
};

/// Returns the images of one task of a plan of several images.
Assignment planned_assignment(const RenderArguments& asked, const Plan& plan)
{
    const PlanTask& task = find_task(plan, *asked.part->plan, asked.part->task);
    std::vector<SequenceView> views = make_views(asked, collect_cameras(plan));
    if (views.size() != plan.images.size()) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is not a plan of bdpt plan: it has {} images, but its options "
                                "give {}",
                                asked.part->plan->string(), plan.images.size(), views.size()));
    }
    const auto begin = views.begin() + static_cast<std::ptrdiff_t>(task.first_image);
    Assignment result{.views = {begin, begin + static_cast<std::ptrdiff_t>(task.images)},
                      .first_image = task.first_image};
    for (std::size_t i = 0; i < task.images; ++i) {
        result.views[i].index = i;
        result.views[i].count = task.images;
    }
    return result;
}

/// Throws `Error` (invalid_input) if files have changed since the plan was made.
void check_files_of_plan(const RenderArguments& asked, const Plan& plan)
{
    if (const auto what = difference(identity_of_files(asked), plan.files)) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: is the plan of another render: {}",
                                                          asked.part->plan->string(), *what));
    }
}

/// Returns the number of samples per pixel that a denoised picture has if none is asked for: about
/// a minute of two processors brings it in a room, and it is clean to the eye. Depends on the size
/// of the whole image, so that a crop has its pixels.
std::int64_t samples_of_denoised_picture(const Size& size)
{
    constexpr std::int64_t least = 8;
    constexpr std::int64_t most_of_image = 12'000'000;
    const std::int64_t pixels = std::int64_t{size.width} * size.height;
    std::int64_t samples = SampleRange{}.end;
    while (samples > least && samples * pixels > most_of_image) {
        samples /= 2;
    }
    return samples;
}

RenderArguments with_samples(RenderArguments image, std::int64_t samples)
{
    image.goal.samples = samples;
    image.samples = {.begin = 0, .end = samples};
    image.options.sampling.planned_samples = samples;
    return image;
}

}  // namespace

RenderArguments with_image_cache(RenderArguments arguments)
{
    if (arguments.sequence && arguments.sequence->frames && arguments.sequence->orbit == 0) {
        arguments.scene.images = std::make_shared<io::ImageCache>(image_cache_bytes(arguments));
    }
    return arguments;
}

RenderArguments completed_for_screens(RenderArguments image, const RenderArguments& asked,
                                      PreparedScene& stage, std::optional<io::Denoiser>& denoiser,
                                      SharedByViews& shared, Console& console)
{
    if (!std::exchange(shared.is_metered, true) && meters_light(asked, stage)) {
        shared.exposure = metered_exposure(stage, image);
    }
    image.light_exposure = shared.exposure;
    if (denoiser && asked.denoise.kind == Denoising::automatic && !shared.guides) {
        shared.guides = spend_guides(stage.memory, asked);
        if (!shared.guides) {
            console.note(
                Note{"not_denoised",
                     "not denoised: too little memory is left (--denoise denoises anyway)"},
                Repeat::never);
            denoiser.reset();
            image.denoise.kind = Denoising::none;
        }
    }
    if (!shared.has_ground) {
        shared.has_ground = adds_ground(image, stage) &&
                            std::any_of(image.outputs.begin(), image.outputs.end(), is_for_screens);
        if (*shared.has_ground) {
            spend_ground(stage.memory, asked);
        }
    }
    for (const Aov guide : shared.guides.value_or(std::vector<Aov>())) {
        image = with_screen_aov(std::move(image), guide);
    }
    if (*shared.has_ground) {
        image = with_screen_aov(std::move(image), Aov::shadow);
    }
    return image;
}

JobResult run_render(const RenderArguments& typed, const std::vector<std::string>& words,
                     Console& console, Interrupt& interrupt)
{
    const RenderArguments asked = with_image_cache(typed);
    check_patterns(asked);
    if (const std::optional<std::string> warning =
            warning_of_flicker(asked, FramesBy::one_process)) {
        console.warning(*warning);
    }
    std::optional<PreparedScene> stage;
    const std::optional<Plan> plan = read_task_plan(asked);
    const bool has_planned_sequence = plan && is_sequence(*plan);
    std::optional<Assignment> assignment;
    if (has_planned_sequence) {
        assignment = planned_assignment(asked, *plan);
    }
    if (!assignment && asked.sequence && asked.sequence->cameras == SequenceCameras::all) {
        stage = load(asked, console);
    }
    if (!assignment) {
        assignment = Assignment{
            make_views(asked, stage ? camera_names(*stage) : std::vector<std::string>())};
    }
    const std::vector<SequenceView>& views = assignment->views;
    const auto check_all = [&] {
        const FileSet inputs = stage ? input_files(asked, *stage) : input_files(asked);
        for (const SequenceView& view : views) {
            static_cast<void>(check_files(make_view_arguments(asked, view), inputs));
        }
    };
    check_all();
    check_backplate(asked.display);
    bool knows_scene = stage.has_value();
    std::optional<Display> display;
    if (asked.viewer) {
        display.emplace(*asked.viewer, console);
    }
    std::optional<io::Denoiser> denoiser =
        open_denoiser(asked.denoise, asked.outputs, asked.options.system.threads);
    std::optional<double> time = asked.scene.time;
    std::optional<Viewpoint> first;
    std::optional<Scene> still;  // before its environment was turned
    SharedByViews shared;
    JobResult result;
    for (const SequenceView& view : views) {
        if (interrupt.stopped_by()) {
            break;
        }
        RenderArguments image = make_view_arguments(asked, view);
        console.begin_image(make_label(image));
        interrupt.set_outputs(pending_outputs(check_files(image, input_files(asked))));
        std::optional<PartKeeper> keeper;
        if (image.part) {
            keeper.emplace(
                *image.part,
                plan ? std::optional(planned_identity(*plan, assignment->first_image + view.index))
                     : std::nullopt,
                console);
            if (keeper->is_complete(image.samples) && image.outputs.empty()) {
                report_complete(console, image);
                result.images.push_back(complete_image(image));
                continue;
            }
        }
        if (!stage && has_planned_sequence) {
            check_files_of_plan(asked, *plan);
        }
        if (!stage || time != image.scene.time) {
            interrupt.forbid_stop();
            if (interrupt.stopped_by()) {
                break;
            }
            stage.reset();  // first, to avoid two scenes in memory
            first.reset();
            still.reset();
            shared.guides.reset();
            shared.has_ground.reset();
            stage = load(image, console);
            time = image.scene.time;
        }
        if (!std::exchange(knows_scene, true)) {
            check_all();  // now the files that the scene names are known
        }
        if (!first) {
            first = Viewpoint{
                .camera = stage->camera, .size = stage->size, .is_framed = stage->is_framed};
        }
        image = completed_for_screens(std::move(image), asked, *stage, denoiser, shared, console);
        if (denoiser && image.may_take_few &&
            std::all_of(image.outputs.begin(), image.outputs.end(), is_for_screens)) {
            image = with_samples(std::move(image), samples_of_denoised_picture(stage->size));
        }
        Viewpoint seen = sequence_viewpoint(*stage, *first, image);
        if (view.turn && image.sequence->motion == TurntableMotion::object) {
            if (!still) {
                still = stage->scene;
            }
            stage->scene = with_turned_environment(*still, *view.turn);
        }
        stage->camera = std::move(seen.camera);
        stage->size = seen.size;
        std::optional<JobImage> done =
            render_view(image, *stage, keeper,
                        {console, interrupt, display ? &*display : nullptr,
                         denoiser ? &*denoiser : nullptr, add_view_words(words, view)});
        if (done) {
            result.images.push_back(std::move(*done));
        }
        stage->load_seconds = 0.0;
        stage->build_seconds = 0.0;
    }
    result.stopped = interrupt.stopped_by().has_value();
    return result;
}

RenderArguments for_scene(const RenderArguments& asked, const std::filesystem::path& scene)
{
    RenderArguments one = asked;
    one.file = scene;
    const std::string name = scene.stem().string();
    for (std::filesystem::path& output : one.outputs) {
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

}  // namespace bdpt::job
