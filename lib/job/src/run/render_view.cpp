#include "run/run_render.h"

#include <bdpt/error.h>
#include <bdpt/noise.h>
#include <bdpt/render.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "messages/text.h"
#include "options/groups/transport_arguments.h"
#include "options/output_files.h"
#include "output/image_files.h"
#include "output/parts.h"
#include "output/render_report.h"
#include "output/values.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {
namespace {

using nlohmann::ordered_json;

bool is_one_of_many(const RenderArguments& arguments)
{
    return arguments.sequence_view && arguments.sequence_view->count > 1;
}

void announce(Console& console, const RenderArguments& arguments, const PreparedScene& stage,
              const ordered_json& settings)
{
    const SceneCounts counts = stage.scene.counts();
    console.event("start", {{"version", BDPT_VERSION},
                            {"file", arguments.file.string()},
                            {"triangles", counts.instanced_triangles},
                            {"lights", stage.lights},
                            {"settings", settings}});
    if (is_one_of_many(arguments) && arguments.sequence_view->index > 0) {
        return;  // about the same for all images
    }
    console.note(fmt::format("{}: {}; {}x{}, {}, camera {}", arguments.file.string(),
                             size_text(stage), stage.size.width, stage.size.height,
                             integrator_text(arguments.options, settings.contains("chosen_by")),
                             stage.camera.name));
}

/// Returns the image's name in a viewer: its file, else that of its part.
std::string name_in_viewer(const RenderArguments& arguments)
{
    const std::filesystem::path& file =
        arguments.outputs.empty() ? arguments.part->file : arguments.outputs.front();
    return one_line(file.filename().string());
}

/// Returns the part of `goal` that remains after the `before` samples per pixel, as far as it can
/// be told.
Goal goal_from_now(Goal goal, const Progress& progress, std::int64_t before)
{
    if (goal.samples) {
        goal.samples = progress.samples_total;  // fewer when a part is continued
    }
    if (goal.noise && progress.noise) {
        const std::int64_t needed =
            samples_for_noise(*progress.noise, progress.noise_samples, *goal.noise) - before;
        goal.samples =
            std::min(goal.samples.value_or(needed), std::max(needed, progress.samples_done));
    }
    return goal;
}

/// Calls `continue_render`; errors about `part` are reported with the name of its file.
RenderResult render_or_blame(const PreparedScene& stage, const RenderOptions& options,
                             RenderResult part, const RenderControl& control,
                             const RenderArguments& arguments)
{
    const bool goes_on = !part.samples.empty();
    try {
        return continue_render(stage.scene, stage.camera, options, std::move(part), control);
    } catch (const Error& error) {
        if (!goes_on || error.code() != ErrorCode::invalid_input) {
            throw;
        }
        throw Error(error.code(), fmt::format("{}: {} (--restart replaces it)",
                                              arguments.part->file.string(), error.what()));
    }
}

RenderResult render_stage(const RenderArguments& arguments, const PreparedScene& stage,
                          const io::PartNotes& notes, const RenderSession& session,
                          std::optional<PartKeeper>& keeper)
{
    Interrupt& interrupt = session.interrupt;
    const RenderOptions& options = arguments.options;
    RenderResult part;
    RenderControl control;
    control.stop = interrupt.stop_token();
    Goal goal = arguments.goal;
    goal.seconds = std::max(goal.seconds - stage.load_seconds - stage.build_seconds, 0.0);
    control.time_limit = goal.seconds;
    if (goal.seconds == 0.0) {
        session.console.note("loading took longer than --time: one pass is rendered");
    }
    control.noise_goal = arguments.goal.noise.value_or(0.0);
    if (keeper) {
        part = keeper->start(identity(stage.scene, stage.camera, options), notes);
    }
    if (session.display != nullptr) {
        session.display->begin_image(name_in_viewer(arguments));
    }
    control.on_part = [&](const RenderResult& now) {
        if (keeper && !interrupt.stopped_by()) {  // otherwise it is written in a moment
            const bool asked = interrupt.take_checkpoint_request();
            keeper->after_pass(now, asked ? Checkpoint::now : Checkpoint::when_due);
        }
        if (session.display != nullptr) {
            session.display->after_pass(now.film);
        }
    };
    control.on_progress = [&, before = part.samples.count()](const Progress& progress) {
        session.console.progress(progress, goal_from_now(goal, progress, before));
    };
    RenderResult result = render_or_blame(stage, options, std::move(part), control, arguments);
    session.console.end_progress();
    if (session.display != nullptr) {
        session.display->finish(result.film);
    }
    return result;
}

io::PartNotes part_notes(const RenderArguments& arguments, io::ImageMetadata metadata,
                         const std::vector<std::string>& words)
{
    // With a noise goal no samples are missing when the render stops.
    const bool known = arguments.goal.samples && !arguments.goal.noise;
    std::vector<std::string> command = render_words(words);
    if (arguments.strategies) {
        command.push_back(
            fmt::format("--strategy-depth={}", arguments.options.bidirectional.strategy_depth));
    }
    return {.goal = known ? SampleSet(arguments.samples) : SampleSet(),
            .metadata = std::move(metadata),
            .command = command};
}

ordered_json head_of_stats(const RenderArguments& arguments, const ordered_json& settings,
                           const std::optional<std::string>& stopped_by)
{
    ordered_json stats{
        {"version", BDPT_VERSION}, {"file", arguments.file.string()}, {"settings", settings}};
    stats["stopped_by"] = or_null(stopped_by);
    return stats;
}

/// Returns the end of an advice about noise: how to denoise.
const char* denoising_advice(const RenderArguments& arguments, const WrittenImages& images)
{
    if (!images.denoised.empty()) {
        return "";
    }
    const bool has_pictures = std::any_of(images.files.begin(), images.files.end(), is_for_screens);
    return arguments.denoise.kind == Denoising::automatic && has_pictures && !arguments.part &&
                   images.why_noisy.empty()
               ? ", or install Open Image Denoise (\"Denoising\" in docs/render.md)"
               : ", or --denoise";
}

/// Prints advice about visible remaining noise.
void note_noise(Console& console, const RenderArguments& arguments, double noise,
                const WrittenImages& images)
{
    constexpr double preview = 0.05;
    if (std::isfinite(noise) && noise > preview && !arguments.goal.noise &&
        !arguments.outputs.empty()) {
        console.detail(fmt::format("noise {}{}: more --time or --spp{}", noise_text(noise),
                                   images.denoised.empty() ? "" : " before denoising",
                                   denoising_advice(arguments, images)));
    }
}

/// Returns ", exposure 1.25 EV" for a file that has one.
std::string exposure_text(const std::filesystem::path& file, const std::optional<float>& exposure)
{
    return exposure && is_for_screens(file) ? fmt::format(", exposure {:.2f} EV", *exposure) : "";
}

/// Returns ", denoised" for a file that is.
std::string denoised_text(const std::filesystem::path& file, const WrittenImages& images)
{
    return is_among(images.denoised, file) ? ", denoised" : "";
}

/// Prints the written files: a line per file or, for a sequence, one line.
void note_done(Console& console, const RenderArguments& arguments, const RenderResult& result,
               const WrittenImages& images)
{
    std::vector<std::filesystem::path> files = images.files;
    const std::string work =
        fmt::format("{} spp in {:.1f} s", result.film.sample_count(), result.seconds);
    if (!is_one_of_many(arguments)) {
        for (const std::filesystem::path& file : files) {
            const std::string denoised = denoised_text(file, images);
            const bool was_asked = denoised.empty() || arguments.denoise.is_asked();
            console.note(fmt::format("wrote {}: {}{}{}{}", file.string(), work,
                                     exposure_text(file, images.exposure), denoised,
                                     was_asked ? "" : " (--denoise=false writes it as it is)"));
        }
        return;
    }
    if (files.empty() && arguments.part) {
        files.push_back(arguments.part->file);
    }
    std::string names;
    for (const std::filesystem::path& file : files) {
        names += (names.empty() ? "" : ", ") + file.string() +
                 exposure_text(file, images.exposure) + denoised_text(file, images);
    }
    console.note(fmt::format("{}: {}: wrote {}", label_text(make_label(arguments)), work, names));
}

void report_done(Console& console, const RenderArguments& arguments, const RenderResult& result,
                 double noise, const WrittenImages& images,
                 const std::optional<std::string>& stopped_by)
{
    ordered_json fields{{"samples", result.film.sample_count()},
                        {"seconds", result.seconds},
                        {"outputs", names_json(images.files)},
                        {"denoised", names_json(images.denoised)}};
    fields["noise"] = noise_json(noise);
    note_noise(console, arguments, noise, images);
    const std::optional<double> goal = arguments.goal.noise;
    if (goal && !std::isfinite(noise)) {
        const auto samples = static_cast<std::size_t>(result.film.sample_count());
        console.note(
            {"noise_unknown", fmt::format("the noise is not known after {} per pixel (--noise)",
                                          counted(samples, "sample"))});
    } else if (goal && noise > *goal) {
        const std::int64_t samples = samples_for_noise(noise, result.film.sample_count(), *goal);
        console.note({"noise_above_goal",
                      fmt::format("the noise is {}, more than {} (--noise): about {} samples per "
                                  "pixel are needed",
                                  noise_text(noise), noise_text(*goal), samples)});
    }
    fields["exposure"] = or_null(images.exposure);
    fields["stopped_by"] = or_null(stopped_by);
    console.event("done", fields);
}

/// Tests whether the pilot of the integrator may choose rates. A part keeps those that it has, or
/// none. Renders of a given time have none: they may end before a group of samples.
bool may_choose_rates(const RenderArguments& asked, const std::optional<PartKeeper>& keeper)
{
    const std::optional<bool> of_part = keeper ? keeper->has_rates() : std::nullopt;
    return asked.may_adapt && of_part.value_or(!std::isfinite(asked.goal.seconds));
}

/// Returns `images`, those of strategies among them, and all other files that were written.
std::vector<std::filesystem::path> written_files(const RenderArguments& arguments,
                                                 std::vector<std::filesystem::path> images)
{
    for_each_written_file(arguments,
                          [&](std::string_view option, const std::filesystem::path& file) {
                              if (option != "--output" && option != "--strategies") {
                                  images.push_back(file);
                              }
                          });
    return images;
}

}  // namespace

ImageLabel make_label(const RenderArguments& arguments)
{
    if (!arguments.sequence_view) {
        return {};
    }
    const SequenceView& view = *arguments.sequence_view;
    return {.frame = view.frame,
            .camera = view.camera ? std::optional(view.camera_name) : std::nullopt,
            .index = view.index,
            .count = view.count};
}

std::optional<JobImage> render_view(const RenderArguments& given, const PreparedScene& stage,
                                    std::optional<PartKeeper>& keeper, const RenderSession& session)
{
    Console& console = session.console;
    Interrupt& interrupt = session.interrupt;
    RenderArguments asked = given;
    asked.may_adapt = may_choose_rates(given, keeper);
    const auto choosing_start = std::chrono::steady_clock::now();
    const RenderArguments arguments = with_choice(asked, stage, console, interrupt.stop_token());
    if (interrupt.stopped_by()) {
        return std::nullopt;
    }
    const double choosing = seconds_since(choosing_start);
    ordered_json settings = make_settings(arguments, stage);
    if (asked.options.integrator == IntegratorKind::automatic) {
        settings["chosen_by"] = "auto";
    }
    const double light_beyond = light_beyond_max_depth(arguments, stage);
    if (light_beyond > 0.0) {
        settings["light_beyond_max_depth"] = std::round(light_beyond * 1000.0) / 1000.0;
    }
    interrupt.allow_stop();
    announce(console, arguments, stage, settings);
    tell_findings(console, stage);
    tell_of_no_effect(console, arguments, stage);
    const bool is_first = !is_one_of_many(arguments) || arguments.sequence_view->index == 0;
    if (light_beyond > 0.0 && is_first) {  // about the same for all images
        console.note(
            {"light_beyond_max_depth",
             fmt::format("about {:.2g} % of the light is missing: its paths have more than {} "
                         "edges (--max-depth)",
                         100.0 * light_beyond, arguments.options.transport.max_depth)});
    }
    const io::ImageMetadata metadata = make_metadata(arguments, stage, settings);
    if (arguments.saved_rates) {
        save_rates(*arguments.saved_rates, arguments.options, metadata);
    }
    const RenderResult result = render_stage(
        arguments, stage, part_notes(arguments, metadata, session.words), session, keeper);
    const bool stopped = interrupt.stopped_by().has_value();
    Attempts attempts;
    if (keeper) {
        attempts.run([&] { keeper->finish(result); });
    }
    warn_of_defects(console, result.film.defects());

    const auto writing_start = std::chrono::steady_clock::now();
    const Image image = result.image();
    report_clamp(console, result.film, image);
    ImageFileOptions options =
        image_file_options(result, completed(metadata, result.film.sample_count(), result.seconds),
                           arguments.exr, arguments.display, session.denoiser, arguments.denoise);
    options.screen_aovs = arguments.screen_aovs;
    const bool is_whole = !arguments.options.film.crop;
    if (is_whole && stage.scene.counts().lights > 0 && is_black(image, options.layers)) {
        console.warning(black_image_text(arguments.file.string()));
    }
    WrittenImages images = write_image_files(arguments.outputs, image, options, attempts);
    if (!images.why_noisy.empty()) {
        console.warning(fmt::format("not denoised: {}", images.why_noisy));
    }
    if (arguments.strategies && !arguments.strategies->both().empty()) {
        const bool written = attempts.run([&] {
            write_strategy_files(
                *arguments.strategies, image, result.strategies, options.exr,
                shown_exposure(arguments.display.exposure, options.exr.metadata, image));
        });
        if (written) {
            const std::vector<std::filesystem::path> both = arguments.strategies->both();
            images.files.insert(images.files.end(), both.begin(), both.end());
        }
    }
    const double writing = seconds_since(writing_start);
    if (images.clamped_pixels > 0) {
        console.warning(
            fmt::format("{} pixels exceed 65504 and are clamped to it; --float keeps them",
                        images.clamped_pixels));
    }
    const std::optional<std::string> stopped_by = interrupt.stopped_by();
    if (arguments.stats) {
        ordered_json stats = head_of_stats(arguments, settings, stopped_by);
        stats.update(stats_json(result, {.load = stage.load_seconds,
                                         .build = stage.build_seconds,
                                         .choose = choosing,
                                         .render = result.seconds,
                                         .write = writing}));
        const std::uint64_t while_rendering = light_path_bytes(arguments.options) +
                                              strategy_image_bytes(arguments.options, stage.camera);
        stats["memory"] = {{"estimated_bytes", stage.memory.spent() + while_rendering},
                           {"limit_bytes", stage.memory.limit().bytes},
                           {"limit", stage.memory.limit().source}};
        if (arguments.part) {
            stats["part"] = {{"file", arguments.part->file.string()},
                             {"samples", result.samples.text()},
                             {"cpu_seconds", result.cpu_seconds}};
        }
        attempts.run([&] { write_stats_file(*arguments.stats, stats); });
    }
    if (stopped_by) {
        console.note(fmt::format("stopped by {} after {} samples per pixel", *stopped_by,
                                 result.film.sample_count()));
    }
    note_done(console, arguments, result, images);
    attempts.finish();
    const double noise = estimate_noise(result.film, result.aovs);
    report_done(console, arguments, result, noise, images, stopped_by);
    const ImageLabel label = make_label(arguments);
    return JobImage{.files = written_files(arguments, std::move(images.files)),
                    .frame = label.frame,
                    .camera = label.camera,
                    .samples_per_pixel = result.film.sample_count(),
                    .seconds = result.seconds,
                    .noise = noise,
                    .exposure = images.exposure,
                    .stopped = stopped};
}

}  // namespace bdpt::job
