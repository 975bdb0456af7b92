#include "commands/merge_command.h"

#include <bdpt/error.h>
#include <bdpt/io/part_file.h>
#include <bdpt/noise.h>
#include <bdpt/part/render_part.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options/values/output_files.h"
#include "plan/plan.h"
#include "report/denoised.h"
#include "report/image_files.h"
#include "report/part/part_collection.h"
#include "report/part/part_command.h"
#include "report/stats_file.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using io::PartInfo;
using nlohmann::ordered_json;

constexpr int default_threads = 0;  // one for each processor

/// Commands that render `missing`.
std::vector<std::string> commands_for_missing(const SampleSet& missing,
                                              const PartCollection& collection,
                                              const MergeArguments& arguments)
{
    if (arguments.plan) {
        return commands_for(read_plan(*arguments.plan), *arguments.plan, missing);
    }
    const PartInfo& part = collection.parts.front();
    return commands_for(part.notes.command, missing, part.file.parent_path());
}

std::string message_of_missing(const PartCollection& collection, const MergeArguments& arguments)
{
    constexpr std::size_t most_shown = 3;
    const SampleSet missing = collection.missing();
    std::string text = fmt::format("samples are missing: {}", missing.text());
    if (arguments.plan) {
        text += fmt::format(" (tasks {} of {})", tasks_text(read_plan(*arguments.plan), missing),
                            arguments.plan->string());
    }
    const std::vector<std::string> commands = commands_for_missing(missing, collection, arguments);
    for (std::size_t i = 0; i < std::min(commands.size(), most_shown); ++i) {
        text += (i == 0 ? "; to render them: " : " && ") + commands[i];
    }
    if (commands.size() > most_shown) {
        text += fmt::format(" && ... ({} more)", commands.size() - most_shown);
    }
    return collection.parts.empty() ? text : text + "; --partial writes what there is";
}

/// The settings that the parts have, with the number of samples of all and what is put behind.
std::string settings_of(const std::string& text, std::int64_t samples,
                        const std::optional<Backdrop>& backdrop)
{
    ordered_json settings = ordered_json::parse(text, nullptr, false);
    if (!settings.is_object()) {
        return text;
    }
    settings["spp"] = samples;
    if (backdrop) {
        settings["background"] = backdrop_text(*backdrop);
    }
    settings.erase("time_limit_seconds");
    settings.erase("noise_goal");
    return settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Parts without the environment behind them get the backdrop that was asked for when they were
/// rendered, or another one now.
DisplayArguments with_backdrop_of(const io::ImageMetadata& metadata, DisplayArguments display)
{
    const ordered_json settings = ordered_json::parse(metadata.settings, nullptr, false);
    std::optional<Backdrop> own;
    if (settings.is_object() && settings.contains("background") &&
        settings["background"].is_string()) {
        own = parse_backdrop(settings["background"].get<std::string>());
    }
    if (display.backdrop && !own) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--background \"{}\": the parts show the environment; render them "
                                "with --background, too",
                                backdrop_text(*display.backdrop)));
    }
    display.backdrop = display.backdrop ? display.backdrop : own;
    return display;
}

void write_outputs(const MergeArguments& arguments, const DisplayArguments& display,
                   const io::Denoiser* denoiser, const RenderPart& part, io::PartNotes notes)
{
    notes.metadata.samples_per_pixel = part.samples.count();
    notes.metadata.render_seconds = part.cpu_seconds;
    notes.metadata.created = std::chrono::system_clock::now();
    notes.metadata.settings =
        settings_of(notes.metadata.settings, part.samples.count(), display.backdrop);
    std::vector<fs::path> images;
    for (const fs::path& output : arguments.outputs) {
        if (is_part_name(output)) {
            io::write_part(output, part, notes, io::OldPart::replace);
        } else {
            images.push_back(output);
        }
    }
    if (images.empty()) {
        return;
    }
    const FilmLayout& layout = part.film.layout();
    const io::ExrPlacement placement{.x = layout.region.x0,
                                     .y = layout.region.y0,
                                     .full_width = layout.width,
                                     .full_height = layout.height};
    write_image_files(
        images, part.film.develop(),
        {.exr = {arguments.channel_type, std::move(notes.metadata), arguments.storage, placement},
         .layers = part.aovs.develop(part.film),
         .display = display,
         .denoiser = denoiser,
         .denoised_as = arguments.denoise ? arguments.denoise->as : DenoisedAs::image});
}

/// The noise of the whole, and which samples it lacks for what was asked for, if anything was.
ordered_json judge_noise(const MergeArguments& arguments, const RenderPart& sum,
                         const PartInfo& part, Console& console)
{
    const double noise = noise_of(sum.film);
    ordered_json fields{{"noise", noise_json(noise)}};
    if (!arguments.noise) {
        return fields;
    }
    if (noise <= *arguments.noise) {
        console.note(fmt::format("the noise is {}: not above {}", noise_text(noise),
                                 noise_text(*arguments.noise)));
        fields["missing_for_noise"] = "";
        return fields;
    }
    const std::int64_t samples = samples_for_noise(noise, sum.samples.count(), *arguments.noise);
    const SampleSet more = sum.samples.missing(SampleSet({.begin = 0, .end = samples}));
    std::string text = fmt::format("the noise is {}: for {} the samples {} are missing",
                                   noise_text(noise), noise_text(*arguments.noise), more.text());
    for (const std::string& command :
         commands_for(part.notes.command, more, part.file.parent_path())) {
        text += "; to render them: " + command;
    }
    console.note(text);
    fields["missing_for_noise"] = more.text();
    return fields;
}

}  // namespace

int run_merge(const MergeArguments& arguments)
{
    check_outputs(arguments.outputs, arguments.parts);
    Console console(arguments.format, arguments.verbosity);
    // Nothing is worth finishing; but nothing half-written is left, either.
    const Interrupt interrupt(temporary_paths(arguments.outputs), [] {});
    const std::optional<io::Denoiser> denoiser =
        open_denoiser(arguments.denoise, arguments.outputs, default_threads);
    const PartCollection collection = collect_parts(arguments, console);
    const std::vector<PartInfo>& parts = collection.parts;
    for (const std::string& note : collection.notes) {
        console.note(note);
    }
    for (const std::string& fault : collection.faults) {
        console.warning(fault);
    }
    const SampleSet missing = collection.missing();
    if (parts.empty() || (!missing.empty() && arguments.incomplete == Incomplete::refuse)) {
        report_error(arguments.format, merge_incomplete,
                     parts.empty() && !arguments.plan ? "none of the parts is there"
                                                      : message_of_missing(collection, arguments));
        return merge_incomplete;
    }
    const DisplayArguments display =
        with_backdrop_of(parts.front().notes.metadata, arguments.display);
    RenderPart sum;
    for (const PartInfo& part : parts) {
        io::merge_part(sum, part);
    }
    io::PartNotes notes = parts.front().notes;
    notes.goal = collection.goal;
    write_outputs(arguments, display, denoiser ? &*denoiser : nullptr, sum, std::move(notes));

    if (!missing.empty()) {
        console.warning(fmt::format("samples are missing: {}", missing.text()));
    }
    ordered_json outputs = ordered_json::array();
    for (const fs::path& output : arguments.outputs) {
        outputs.push_back(output.string());
        console.note(fmt::format("wrote {}: {} spp of {} parts, {:.1f} s of CPU time",
                                 output.string(), sum.samples.count(), parts.size(),
                                 sum.cpu_seconds));
    }
    ordered_json fields{{"samples", sum.samples.count()},
                        {"missing", missing.text()},
                        {"cpu_seconds", sum.cpu_seconds},
                        {"outputs", std::move(outputs)}};
    fields.update(judge_noise(arguments, sum, parts.front(), console));
    console.event("done", fields);
    return 0;
}

}  // namespace bdpt::app
