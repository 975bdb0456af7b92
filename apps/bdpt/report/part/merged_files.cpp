#include "report/part/merged_files.h"

#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "options/groups/strategy_arguments.h"
#include "options/values/output_files.h"
#include "plan/plan_file.h"
#include "report/image/display_sources.h"
#include "report/image/image_files.h"
#include "report/render_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Parses the settings `text` of a part. Invalid JSON is discarded, and so is text longer or deeper
/// than that of any render, as keys are searched linearly and text is written recursively.
ordered_json parsed_settings(const std::string& text)
{
    constexpr std::size_t max_length = std::size_t{64} << 10;
    const ordered_json discarded = ordered_json::parse("", nullptr, false);
    if (text.size() > max_length) {
        return discarded;
    }
    try {
        static_cast<void>(io::JsonValue::parse(text));
    } catch (const Error&) {
        return discarded;
    }
    return ordered_json::parse(text, nullptr, false);
}

/// Returns the settings of the parts, with the total number of samples and the backdrop.
std::string merge_settings(const std::string& text, std::int64_t samples,
                           const std::optional<Backdrop>& backdrop)
{
    ordered_json settings = parsed_settings(text);
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

DisplayArguments display_of_parts(const io::PartInfo& part, DisplayArguments display)
{
    const io::ImageMetadata& metadata = part.notes.metadata;
    const ordered_json settings = parsed_settings(metadata.settings);
    std::optional<Backdrop> own;
    if (settings.is_object() && settings.contains("background") &&
        settings["background"].is_string()) {
        own = parse_backdrop(settings["background"].get<std::string>());
        if (own && !own->photo.empty()) {
            own->photo = find_photo(own->photo, part.file);
        }
    }
    if (display.backdrop && !own) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--background \"{}\": the parts contain the environment; render "
                                "them with --background, too",
                                backdrop_text(*display.backdrop)));
    }
    display.backdrop = display.backdrop ? display.backdrop : own;
    check_metered(display.exposure, metadata, "the parts");
    return display;
}

void check_merged_files(std::span<const MergeArguments> images)
{
    FileSet inputs;
    for (const MergeArguments& image : images) {
        inputs.add(image.parts);
        if (image.plan) {
            inputs.add(*image.plan);
        }
        if (image.denoise.library) {
            inputs.add(*image.denoise.library);
        }
        if (image.display.backdrop && !image.display.backdrop->photo.empty()) {
            inputs.add(image.display.backdrop->photo);
        }
    }
    for (const MergeArguments& image : images) {
        check_outputs(image.outputs, inputs);
        if (image.strategies) {
            check_strategy_files(StrategyFiles::named(*image.strategies), inputs, image.outputs);
        }
    }
}

void check_strategies(const MergeArguments& arguments, const io::PartInfo& part)
{
    const auto& components = part.identity.components;
    const bool has_images =
        std::any_of(components.begin(), components.end(), [](const IdentityComponent& component) {
            return component.name == "option: strategy_depth" && component.value != "0";
        });
    if (arguments.strategies && !has_images) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--strategies \"{}\": {} has no strategy images; render the parts "
                                "with --strategy-depth",
                                arguments.strategies->string(), part.file.string()));
    }
}

std::vector<fs::path> merged_files(const MergeArguments& arguments)
{
    std::vector<fs::path> files = arguments.outputs;
    if (arguments.strategies) {
        const std::vector<fs::path> more = StrategyFiles::named(*arguments.strategies).both();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

std::vector<fs::path> write_merged_files(const MergeArguments& arguments,
                                         const DisplayArguments& display,
                                         const io::Denoiser* denoiser, const RenderResult& part,
                                         io::PartNotes notes)
{
    notes.metadata.samples_per_pixel = part.samples.count();
    notes.metadata.render_seconds = part.cpu_seconds;
    notes.metadata.created = std::chrono::system_clock::now();
    notes.metadata.settings =
        merge_settings(notes.metadata.settings, part.samples.count(), display.backdrop);
    std::vector<fs::path> images;
    Attempts attempts;
    for (const fs::path& output : arguments.outputs) {
        if (is_part_name(output)) {
            attempts.run([&] { io::write_part(output, part, notes, io::OldPart::replace); });
        } else {
            images.push_back(output);
        }
    }
    if (images.empty() && !arguments.strategies) {
        attempts.finish();
        return {};
    }
    const FilmLayout& layout = part.film.layout();
    const io::ExrPlacement placement{.x = layout.region.x0,
                                     .y = layout.region.y0,
                                     .full_width = layout.width,
                                     .full_height = layout.height};
    const Image image = part.image();
    const ImageFileOptions options{.exr = {.type = arguments.exr.channel_type,
                                           .metadata = std::move(notes.metadata),
                                           .storage = arguments.exr.storage,
                                           .placement = placement,
                                           .manifests = part.ids.manifests()},
                                   .layers = develop_layers(part.film, part.aovs, part.ids),
                                   .display = display,
                                   .denoiser = denoiser,
                                   .denoising = arguments.denoise.kind};
    WrittenImages written = write_image_files(images, image, options, attempts);
    if (arguments.strategies) {
        attempts.run([&] {
            write_strategy_files(StrategyFiles::named(*arguments.strategies), image,
                                 part.strategies, options.exr,
                                 shown_exposure(display.exposure, options.exr.metadata, image));
        });
    }
    attempts.finish();
    return std::move(written.denoised);
}

namespace {

namespace fs = std::filesystem;

/// Returns the files that the plan in `file` names for image `image`.
std::set<fs::path> planned_files(const Plan& plan, const fs::path& file, std::size_t image)
{
    const auto name = [&](const fs::path& path) {
        return expand_pattern(resolved(path, file), plan.images[image]);
    };
    std::set<fs::path> result;
    for (const fs::path& output : plan.outputs) {
        result.insert(name(output));
    }
    if (plan.strategies) {
        const std::vector<fs::path> both = StrategyFiles::named(name(*plan.strategies)).both();
        result.insert(both.begin(), both.end());
    }
    return result;
}

}  // namespace

void check_planned_outputs(const MergeArguments& arguments, const Plan& plan)
{
    const std::set<fs::path> planned = planned_files(plan, *arguments.plan, arguments.image);
    for (const fs::path& file : merged_files(arguments)) {
        std::error_code ignored;
        if (planned.contains(file) && fs::exists(file, ignored) && !is_file_of_ours(file)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot write: the plan names it, but it is not an image "
                                    "of bdpt; remove it, or name other files with -o",
                                    file.string()));
        }
    }
}

}  // namespace bdpt::app
