#include "report/part/merged_files.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/image_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

}  // namespace

DisplayArguments display_of_parts(const io::ImageMetadata& metadata, DisplayArguments display)
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

void write_merged_files(const MergeArguments& arguments, const DisplayArguments& display,
                        const RenderPart& part, io::PartNotes notes)
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
         .display = display});
}

}  // namespace bdpt::app
