#include "commands/render_command.h"

#include <bdpt/error.h>
#include <bdpt/eval/bench/option_names.h>
#include <bdpt/io/tone_map.h>
#include <bdpt/render.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "options/film_memory.h"
#include "options/output_files.h"
#include "options/strategy_arguments.h"
#include "options/transport_arguments.h"
#include "report/image_files.h"
#include "report/render_settings.h"
#include "report/stats_file.h"
#include "report/strategy_files.h"
#include "stage/darkness.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

/// What the film takes of --max-memory; 0 without a limit.
std::uint64_t reserved_bytes(const RenderArguments& arguments)
{
    if (!arguments.max_memory) {
        return 0;
    }
    // Without --size, as large as it can be.
    const Size size = arguments.size.value_or(default_size(std::nullopt));
    const std::uint64_t bytes = film_bytes(arguments.options, size);
    if (bytes >= *arguments.max_memory) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("the film of {}x{} pixels takes {} bytes, but the limit is {} "
                                "(--max-memory); a smaller --size, --crop or fewer layers of --aov "
                                "take less",
                                size.width, size.height, bytes, *arguments.max_memory));
    }
    return bytes;
}

/// Loads the scene into the memory that the film leaves.
PreparedScene prepare_within_memory(RenderArguments arguments)
{
    const std::uint64_t film = reserved_bytes(arguments);
    if (film == 0) {
        return prepare_scene(arguments);
    }
    const std::uint64_t left = *arguments.max_memory - film;
    arguments.scene.limits = io::limits_within(left);
    try {
        return prepare_scene(arguments);
    } catch (const Error& error) {
        const std::string message = error.what();
        if (message.find("limit is") == std::string::npos &&
            message.find("of memory in all") == std::string::npos) {
            throw;
        }
        throw Error(error.code(), fmt::format("{} (--max-memory {} less {} for the film)", message,
                                              *arguments.max_memory, film));
    }
}

/// That the image will show next to nothing, and what helps.
std::optional<std::string> warning_of_darkness(const RenderArguments& arguments,
                                               const PreparedScene& stage)
{
    constexpr double nearly_all = 0.9;
    if (!stage.only_emitters || arguments.environment) {
        return std::nullopt;
    }
    const double dark = dark_share(stage, arguments.options, arguments.exposure);
    if (dark < nearly_all) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: nearly black: the only lights of the file are surfaces that emit, and {:.0f} % of "
        "what "
        "the camera sees gets next to no light; --env default adds a soft sky",
        arguments.file.string(), 100.0 * dark);
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
    console.note(fmt::format("{}: {}, {}; {}x{}, {}, camera {}", arguments.file.string(),
                             counted(counts.instanced_triangles, "triangle"),
                             counted(stage.lights, "light"), stage.size.width, stage.size.height,
                             integrator_text(arguments.options, settings.contains("chosen_by")),
                             stage.camera.name));
}

RenderOptions options_for(const RenderArguments& arguments, const PreparedScene& stage,
                          Console& console)
{
    // With --time alone, more samples than anyone has time for.
    constexpr std::int64_t no_limit = std::int64_t{1} << 31;
    RenderOptions options = arguments.options;
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    options.sampling.samples = {0, arguments.goal.samples.value_or(no_limit)};
    if (arguments.max_memory) {
        options.bidirectional.strategy_memory =
            std::min(options.bidirectional.strategy_memory,
                     *arguments.max_memory - reserved_bytes(arguments));
        options.bidirectional.light_path_memory =
            std::min(options.bidirectional.light_path_memory,
                     *arguments.max_memory - reserved_bytes(arguments));
    }
    if (arguments.strategies) {
        const StrategyDepth depth = strategy_depth(*arguments.strategies, options, stage.camera);
        options.bidirectional.strategy_depth = depth.edges;
        if (depth.warning) {
            console.warning(*depth.warning);
        }
    }
    return options;
}

/// What is left open in the options is chosen; the rest stays.
RenderArguments with_choice(RenderArguments arguments, const PreparedScene& stage, Console& console)
{
    arguments.options =
        chosen_options(stage.scene, stage.camera, options_for(arguments, stage, console));
    return arguments;
}

RenderResult render_stage(const RenderArguments& arguments, const PreparedScene& stage,
                          Console& console, const std::stop_token& stop)
{
    RenderControl control;
    control.stop = stop;
    control.time_limit = arguments.goal.seconds;
    control.profiling = arguments.profiling;
    control.on_progress = [&](const Progress& progress) {
        console.progress(progress, arguments.goal);
    };
    RenderResult result = render(stage.scene, stage.camera, arguments.options, control);
    console.end_progress();
    return result;
}

/// The same; the console shows how far loading is.
RenderArguments with_progress(RenderArguments arguments, Console& console)
{
    const auto start = std::chrono::steady_clock::now();
    arguments.scene.on_progress = [&console, start](const io::LoadProgress& progress) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        constexpr double report_threshold = 1.0;  // [s]
        if (passed.count() < report_threshold) {
            return;
        }
        const double done =
            static_cast<double>(progress.images_done) / static_cast<double>(progress.images_total);
        console.task({.fraction = done,
                      .seconds = passed.count(),
                      .seconds_left = passed.count() * (1.0 - done) / done,
                      .activity = fmt::format("loading textures, {}/{}", progress.images_done,
                                              progress.images_total)});
    };
    return arguments;
}

void warn_of_defects(Console& console, const FilmDefects& defects)
{
    if (defects.invalid > 0) {
        const FilmDefects::Place place = defects.first_invalid.value_or(FilmDefects::Place{});
        console.warning(
            fmt::format("{} contributions were NaN, infinite or negative and were dropped; the "
                        "first at pixel ({}, {}), sample {}",
                        defects.invalid, place.x, place.y, place.sample_index));
    }
    if (defects.saturated > 0) {
        console.warning(fmt::format("{} contributions were above {:.3g} nit and count as that",
                                    defects.saturated, ExactSum::max_value));
    }
}

void report_clamp(Console& console, const Film& film, const Image& image)
{
    const ClampLoss loss = film.clamp_loss();
    if (loss.contributions == 0) {
        return;
    }
    const auto sum = [](Rgb c) { return static_cast<double>(c.r + c.g + c.b); };
    double left = 0.0;
    for (const Rgb& pixel : image.pixels) {
        left += sum(pixel) / static_cast<double>(image.pixels.size());
    }
    const double taken = sum(loss.radiance);
    console.note(fmt::format("clamping at {:g} nit took {:.2f} % of the light: {} contributions",
                             film.layout().clamp, 100.0 * taken / (left + taken),
                             loss.contributions));
}

/// Microseconds of a sample: seconds would be too small for files of 16 bits.
Layer time_layer(const TimeProfile& profile)
{
    Layer layer{.name = "time",
                .channels = "Y",
                .width = profile.region.width(),
                .height = profile.region.height(),
                .values = profile.pixel_seconds};
    for (float& value : layer.values) {
        value *= 1e6f;
    }
    return layer;
}

ImageFileOptions image_file_options(const RenderArguments& arguments, const PreparedScene& stage,
                                    const RenderResult& result, const ordered_json& settings)
{
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    metadata.scene = one_line(arguments.file.string());
    metadata.settings = settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    metadata.integrator = eval::to_string(arguments.options.integrator);
    metadata.seed = arguments.options.sampling.seed;
    metadata.samples_per_pixel = result.film.sample_count();
    metadata.render_seconds = result.seconds;
    metadata.camera = stage.camera;
    metadata.created = std::chrono::system_clock::now();
    metadata.xmp = stage.xmp;
    const PixelRect& region = result.film.region();
    const io::ExrPlacement placement{.x = region.x0,
                                     .y = region.y0,
                                     .full_width = stage.size.width,
                                     .full_height = stage.size.height};
    std::vector<Layer> layers = result.aovs.develop(result.film);
    if (result.profile) {
        layers.push_back(time_layer(*result.profile));
    }
    return {.exr = {arguments.channel_type, std::move(metadata), arguments.storage, placement},
            .layers = std::move(layers),
            .exposure = arguments.exposure};
}

ordered_json head_of_stats(const RenderArguments& arguments, const ordered_json& settings,
                           const std::optional<int>& signal)
{
    ordered_json stats{
        {"version", BDPT_VERSION}, {"file", arguments.file.string()}, {"settings", settings}};
    stats["stopped_by"] = signal ? ordered_json(signal_name(*signal)) : ordered_json();
    return stats;
}

/// Where images go, images of strategies too.
std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments)
{
    std::vector<std::filesystem::path> files = arguments.outputs;
    if (arguments.strategies) {
        const auto more = arguments.strategies->both();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

/// Refuses, before anything is rendered, what could not be written. Returns all that will be.
std::vector<std::filesystem::path> check_files(const RenderArguments& arguments)
{
    std::vector<std::filesystem::path> taken{arguments.file};
    if (arguments.environment) {
        taken.emplace_back(*arguments.environment);
    }
    check_outputs(arguments.outputs, taken);
    taken.insert(taken.end(), arguments.outputs.begin(), arguments.outputs.end());
    std::vector<std::filesystem::path> written = all_image_files(arguments);
    if (arguments.strategies) {
        check_strategy_files(*arguments.strategies, taken);
        const auto more = arguments.strategies->both();
        taken.insert(taken.end(), more.begin(), more.end());
    }
    if (arguments.stats) {
        check_stats_file(*arguments.stats, taken);
        written.push_back(*arguments.stats);
    }
    return written;
}

void report_done(Console& console, const RenderArguments& arguments, const RenderResult& result,
                 const WrittenImages& images, std::optional<int> signal)
{
    ordered_json outputs = ordered_json::array();
    for (const std::filesystem::path& output : all_image_files(arguments)) {
        outputs.push_back(output.string());
        console.note(fmt::format("wrote {}: {} spp in {:.1f} s", output.string(),
                                 result.film.sample_count(), result.seconds));
    }
    ordered_json fields{{"samples", result.film.sample_count()},
                        {"seconds", result.seconds},
                        {"outputs", std::move(outputs)}};
    fields["exposure"] = images.exposure ? ordered_json(*images.exposure) : ordered_json();
    fields["stopped_by"] = signal ? ordered_json(signal_name(*signal)) : ordered_json();
    console.event("done", fields);
}

}  // namespace

int run_render(const RenderArguments& asked)
{
    const std::vector<std::filesystem::path> written = check_files(asked);
    Console console(asked.format, asked.verbosity);
    Interrupt interrupt(temporary_paths(written), [&console] {
        console.note("stopping after the pass in flight; interrupt again to end at once");
    });

    const PreparedScene stage = prepare_within_memory(with_progress(asked, console));
    console.end_progress();
    const auto choosing_start = std::chrono::steady_clock::now();
    const RenderArguments arguments = with_choice(asked, stage, console);
    const std::chrono::duration<double> choosing =
        std::chrono::steady_clock::now() - choosing_start;
    ordered_json settings = settings_of(arguments, stage);
    if (asked.options.integrator == IntegratorKind::automatic) {
        settings["chosen_by"] = "auto";
    }
    interrupt.allow_stop();
    announce(console, arguments, stage, settings);
    for (const std::string& warning : stage.warnings) {
        console.warning(warning);
    }
    if (const std::optional<std::string> warning = warning_of_darkness(arguments, stage)) {
        console.warning(*warning);
    }
    const RenderResult result = render_stage(arguments, stage, console, interrupt.stop_token());
    warn_of_defects(console, result.film.defects());
    if (result.profile) {
        console.event("profile", profile_json(*result.profile));
        console.note(profile_text(*result.profile));
    }

    const auto writing_start = std::chrono::steady_clock::now();
    const Image image = result.film.develop();
    report_clamp(console, result.film, image);
    const ImageFileOptions options = image_file_options(arguments, stage, result, settings);
    const WrittenImages images = write_image_files(arguments.outputs, image, options);
    if (arguments.strategies) {
        write_strategy_files(*arguments.strategies, image, result.strategies, options.exr,
                             arguments.exposure.value_or(io::automatic_exposure(image)));
    }
    const std::chrono::duration<double> writing = std::chrono::steady_clock::now() - writing_start;
    if (images.clamped_pixels > 0) {
        console.warning(
            fmt::format("{} pixels were beyond 65504 and are stored as that; --float "
                        "keeps them",
                        images.clamped_pixels));
    }
    const std::optional<int> signal = interrupt.signal();
    if (arguments.stats) {
        ordered_json stats = head_of_stats(arguments, settings, signal);
        stats.update(stats_json(result, {.load = stage.load_seconds,
                                         .build = stage.build_seconds,
                                         .choose = choosing.count(),
                                         .render = result.seconds,
                                         .write = writing.count()}));
        write_stats_file(*arguments.stats, stats);
    }
    if (signal) {
        console.note(fmt::format("stopped by {} after {} samples per pixel", signal_name(*signal),
                                 result.film.sample_count()));
    }
    report_done(console, arguments, result, images, signal);
    return signal ? 128 + *signal : 0;
}

}  // namespace bdpt::app
