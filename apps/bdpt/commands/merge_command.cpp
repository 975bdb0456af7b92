#include "commands/merge_command.h"

#include <bdpt/error.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/render_part.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options/output_files.h"
#include "report/image_files.h"
#include "report/part_command.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using io::PartInfo;
using nlohmann::ordered_json;

void check_same_render(const PartInfo& first, const PartInfo& other)
{
    if (const auto what = difference(first.identity, other.identity)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is of another render than {}: {}", other.file.string(),
                                first.file.string(), *what));
    }
}

/// Parts of one render, of which none has samples of another. Those that bring nothing are left
/// out.
std::vector<PartInfo> read_parts(const std::vector<fs::path>& files, Console& console)
{
    std::vector<PartInfo> all;
    for (const fs::path& file : files) {
        all.push_back(io::read_part_info(file));
        check_same_render(all.front(), all.back());
    }
    // The larger ones first: what lies in another one comes behind it.
    std::stable_sort(all.begin(), all.end(), [](const PartInfo& a, const PartInfo& b) {
        return a.samples.count() > b.samples.count();
    });
    std::vector<PartInfo> result;
    for (PartInfo& part : all) {
        const auto overlapping = std::find_if(
            result.begin(), result.end(),
            [&](const PartInfo& other) { return !part.samples.overlap(other.samples).empty(); });
        if (overlapping == result.end()) {
            result.push_back(std::move(part));
        } else if (overlapping->samples.contains(part.samples)) {
            console.note(fmt::format("{}: left out, as {} has its samples {}", part.file.string(),
                                     overlapping->file.string(), part.samples.text()));
        } else {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{} and {} both have the samples {}, and each has others",
                                    overlapping->file.string(), part.file.string(),
                                    part.samples.overlap(overlapping->samples).text()));
        }
    }
    return result;
}

/// The samples that the render was to have, as far as parts tell.
SampleSet goal_of(const std::vector<PartInfo>& parts, const std::optional<std::int64_t>& samples)
{
    if (samples) {
        return SampleSet({.begin = 0, .end = *samples});
    }
    std::int64_t end = 0;
    for (const PartInfo& part : parts) {
        end = std::max({end, part.samples.end(), part.notes.goal.end()});
    }
    return SampleSet({.begin = 0, .end = end});
}

std::string message_of_missing(const SampleSet& missing, const PartInfo& part)
{
    constexpr std::size_t most_shown = 3;
    std::string text = fmt::format("samples are missing: {}", missing.text());
    const std::vector<std::string> commands =
        commands_for(part.notes.command, missing, part.file.parent_path());
    for (std::size_t i = 0; i < std::min(commands.size(), most_shown); ++i) {
        text += (i == 0 ? "; to render them: " : " && ") + commands[i];
    }
    if (commands.size() > most_shown) {
        text += fmt::format(" && ... ({} more)", commands.size() - most_shown);
    }
    return text + "; --partial writes what there is";
}

/// The settings that the parts have, with the number of samples of all.
std::string settings_of(const std::string& text, std::int64_t samples)
{
    ordered_json settings = ordered_json::parse(text, nullptr, false);
    if (!settings.is_object()) {
        return text;
    }
    settings["spp"] = samples;
    settings.erase("time_limit_seconds");
    return settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void write_outputs(const MergeArguments& arguments, const RenderPart& part, io::PartNotes notes)
{
    notes.metadata.samples_per_pixel = part.samples.count();
    notes.metadata.render_seconds = part.cpu_seconds;
    notes.metadata.created = std::chrono::system_clock::now();
    notes.metadata.settings = settings_of(notes.metadata.settings, part.samples.count());
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
         .exposure = arguments.exposure});
}

}  // namespace

int run_merge(const MergeArguments& arguments)
{
    check_outputs(arguments.outputs, arguments.parts);
    Console console(arguments.format, arguments.verbosity);
    // Nothing is worth finishing; but nothing half-written is left, either.
    const Interrupt interrupt(temporary_paths(arguments.outputs), [] {});
    const std::vector<PartInfo> parts = read_parts(arguments.parts, console);
    SampleSet samples;
    for (const PartInfo& part : parts) {
        samples.add(part.samples);
    }
    const SampleSet goal = goal_of(parts, arguments.samples);
    const SampleSet missing = samples.missing(goal);
    if (!missing.empty() && arguments.incomplete == Incomplete::refuse) {
        report_error(arguments.format, merge_incomplete,
                     message_of_missing(missing, parts.front()));
        return merge_incomplete;
    }
    RenderPart sum;
    for (const PartInfo& part : parts) {
        io::merge_part(sum, part);
    }
    io::PartNotes notes = parts.front().notes;
    notes.goal = goal;
    write_outputs(arguments, sum, std::move(notes));

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
    console.event("done", {{"samples", sum.samples.count()},
                           {"missing", missing.text()},
                           {"cpu_seconds", sum.cpu_seconds},
                           {"outputs", std::move(outputs)}});
    return 0;
}

}  // namespace bdpt::app
