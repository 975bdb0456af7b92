#include "output/render_report.h"

#include <bdpt/error.h>
#include <bdpt/eval/drawing.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/part_file.h>
#include <bdpt/io/write_image.h>
#include <bdpt/noise.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "messages/text.h"
#include "options/groups/image_arguments.h"
#include "options/groups/view_arguments.h"
#include "options/value_types.h"
#include "output/values.h"

namespace bdpt::job {

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
        console.warning(fmt::format("{} contributions were above {:.3g} nit and were clamped to it",
                                    defects.saturated, ExactSum::max_value));
    }
}

bool is_black(const Image& image, const std::vector<Layer>& layers)
{
    const auto alpha = std::find_if(layers.begin(), layers.end(),
                                    [](const Layer& layer) { return layer.name.empty(); });
    const bool is_empty =
        alpha != layers.end() && std::all_of(alpha->values.begin(), alpha->values.end(),
                                             [](float value) { return value == 0.0f; });
    return !is_empty && std::all_of(image.pixels.begin(), image.pixels.end(),
                                    [](const Rgb& pixel) { return pixel == Rgb(0.0f); });
}

std::string black_image_text(const std::string& scene)
{
    return scene + ": the image is black: none of the light reaches what the camera sees (--env " +
           "default gives a closed room without lights a lamp)";
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
    console.note(
        {"clamped",
         fmt::format("clamping at {:g} nit removed {:.2f} % of the light: {} contributions",
                     film.layout().clamp, 100.0 * taken / (left + taken), loss.contributions)});
}

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json rays_json(const RayCounts& rays, double seconds)
{
    ordered_json result{{"camera", rays.camera},
                        {"light", rays.light},
                        {"shadow", rays.shadow},
                        {"aov", rays.aov},
                        {"total", rays.total()}};
    result["per_second"] =
        seconds > 0.0 ? ordered_json(static_cast<double>(rays.total()) / seconds) : ordered_json();
    return result;
}

ordered_json defects_json(const FilmDefects& defects)
{
    ordered_json result{{"invalid", defects.invalid}, {"saturated", defects.saturated}};
    result["first_invalid"] = nullptr;
    if (const auto& place = defects.first_invalid) {
        result["first_invalid"] = {
            {"x", place->x}, {"y", place->y}, {"sample", place->sample_index}};
    }
    return result;
}

ordered_json clamp_json(const Film& film)
{
    if (film.layout().clamp == std::numeric_limits<float>::infinity()) {
        return nullptr;
    }
    const ClampLoss loss = film.clamp_loss();
    return {{"limit", film.layout().clamp},
            {"contributions", loss.contributions},
            {"radiance_taken", {loss.radiance.r, loss.radiance.g, loss.radiance.b}}};
}

}  // namespace

ordered_json noise_json(double noise)
{
    return std::isfinite(noise) ? ordered_json(noise) : ordered_json();
}

ordered_json stats_json(const RenderResult& result, const TimeSplit& time)
{
    const RenderStats& stats = result.stats;
    ordered_json json{{"samples", result.film.sample_count()},
                      {"seconds",
                       {{"load", time.load},
                        {"build", time.build},
                        {"choose", time.choose},
                        {"render", time.render},
                        {"write", time.write}}},
                      {"paths", {{"camera", stats.paths.camera}, {"light", stats.paths.light}}},
                      {"rays", rays_json(stats.rays, time.render)},
                      {"defects", defects_json(result.film.defects())},
                      {"clamp", clamp_json(result.film)}};
    json["noise"] = noise_json(estimate_noise(result.film, result.aovs));
    return json;
}

void write_stats_file(const fs::path& file, const ordered_json& stats)
{
    write_text(file, stats.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

namespace {

ordered_json view_json(const CameraDesc& camera)
{
    ordered_json view{{"camera", camera.name}};
    add_projection(view, camera);
    return view;
}

/// Returns the name of `file` in metadata.
std::string named(const RenderArguments& arguments, const std::filesystem::path& file)
{
    const bool whole = arguments.path_names == PathNames::paths || !file.has_filename();
    return one_line((whole ? file : file.filename()).string());
}

ordered_json volume_json(const RenderArguments& arguments)
{
    const io::VolumeOptions& options = arguments.volume->options;
    ordered_json json{{"file", named(arguments, arguments.volume->file)}};
    if (options.grid) {
        json["grid"] = one_line(*options.grid);
    }
    json["extinction"] = to_json(options.extinction);
    json["albedo"] = to_json(options.albedo);
    json["anisotropy"] = options.anisotropy;
    json["up"] = options.up == io::UpAxis::z ? "z" : "y";
    return json;
}

ordered_json rates_json(const RenderArguments& arguments)
{
    const SampleRates& rates = *arguments.options.sampling.rates;
    ordered_json json{
        {"least", rates.least()}, {"mean", rates.mean()}, {"greatest", rates.greatest()}};
    const bool pilot = arguments.rates && !arguments.rates->file;
    json["pilot_samples"] = pilot ? rate_pilot_samples : 0;
    return json;
}

}  // namespace

ordered_json make_settings(const RenderArguments& arguments, const PreparedScene& stage)
{
    const RenderOptions& options = arguments.options;
    ordered_json settings{{"width", stage.size.width}, {"height", stage.size.height}};
    settings.update(transport_json(options));
    const auto add_if = [&settings](bool is_set, const char* name, const auto& value) {
        if (is_set) {
            settings[name] = value;
        }
    };
    const auto add = [&settings](const char* name, const auto& value) {
        if (value) {
            settings[name] = *value;
        }
    };
    settings["sampler"] = to_name(options.sampling.sampler);
    settings["seed"] = options.sampling.seed;
    if (options.sampling.rates) {
        settings["rates"] = rates_json(arguments);
    }
    settings["isa"] = isa_name(stage.scene.isa());
    settings.update(view_json(stage.camera));
    settings["environment"] = named(arguments, stage.environment_name);
    const EnvironmentChange& change = arguments.environment_change;
    add_if(change.rotation != 0.0, "environment_rotation_degrees", change.rotation);
    add_if(change.intensity != 1.0f, "environment_intensity", change.intensity);
    if (arguments.fog) {
        settings["fog"] = {{"extinction", to_json(arguments.fog->extinction)},
                           {"albedo", to_json(arguments.fog->albedo)},
                           {"anisotropy", arguments.fog->anisotropy}};
    }
    if (arguments.volume) {
        settings["volume"] = volume_json(arguments);
    }
    if (arguments.display.backdrop) {
        settings["background"] = backdrop_text(*arguments.display.backdrop);
    }
    add("light_exposure", arguments.light_exposure);
    if (options.film.aovs.contains(Aov::shadow) && !is_among(arguments.screen_aovs, Aov::shadow)) {
        settings["ground"] = "shadow";
        const Vec3 lowest(to_file(stage.scene.bounds().min, stage.scene.description().origin));
        settings["ground_height"] = options.film.ground_height.value_or(lowest.y);
    }
    add_if(arguments.texture_filter == TextureFilter::mip_mapped, "texture_filter", "mip");
    add_if(arguments.contacts != ContactKind::automatic, "contacts",
           arguments.contacts == ContactKind::bonded ? "bonded" : "air");
    const FilterOptions& filter = options.film.filter;
    settings["filter"] = to_name(filter.kind);
    settings["filter_radius"] = filter.radius.value_or(default_radius(filter.kind));
    if (options.film.crop) {
        const PixelRect& crop = *options.film.crop;
        settings["crop"] = {crop.x0, crop.y0, crop.x1, crop.y1};
    }
    add_if(std::isfinite(options.film.clamp), "clamp", options.film.clamp);
    add("scene", arguments.scene.scene);
    add("variant", arguments.scene.variant);
    add("animation", arguments.scene.animation);
    add("frame_time", arguments.scene.time);
    if (arguments.scene.shutter) {
        settings["shutter"] = {arguments.scene.shutter->open, arguments.scene.shutter->close};
    }
    if (arguments.sequence && arguments.sequence_view->frame) {
        settings["frame"] = *arguments.sequence_view->frame;
        add_if(arguments.sequence->fps > 0.0, "fps", arguments.sequence->fps);
        add_if(arguments.sequence->orbit > 0, "orbit", arguments.sequence->orbit);
    }
    add("spp", arguments.goal.samples);
    add("noise_goal", arguments.goal.noise);
    add_if(std::isfinite(arguments.goal.seconds), "time_limit_seconds", arguments.goal.seconds);
    return settings;
}

io::ImageMetadata make_metadata(const RenderArguments& arguments, const PreparedScene& stage,
                                const ordered_json& settings)
{
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    metadata.scene = named(arguments, arguments.file);
    metadata.settings = settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    metadata.integrator = to_name(arguments.options.integrator);
    metadata.seed = arguments.options.sampling.seed;
    metadata.camera = stage.camera;
    metadata.origin = stage.scene.description().origin;
    metadata.created = std::chrono::system_clock::now();
    if (arguments.sequence_view && arguments.sequence_view->frame) {
        metadata.frame = io::FrameNumber{.number = *arguments.sequence_view->frame,
                                         .per_second = arguments.sequence_view->fps};
    }
    metadata.xmp = stage.facts.xmp;
    return metadata;
}

void check_strategy_files(const StrategyFiles& files, const FileSet& inputs, const FileSet& outputs)
{
    for (const fs::path& file : files.both()) {
        if (inputs.contains(file) || outputs.contains(file)) {
            throw Error(
                ErrorCode::usage,
                fmt::format(
                    "--strategies \"{}\": {} is an input or another output", files.layers.string(),
                    file == files.layers ? "it" : "the sheet " + file.string() + " beside it"));
        }
        io::check_writable(file);
    }
}

void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure)
{
    io::write_exr(files.layers, image, strategies.develop(), options);
    io::write_png(files.sheet(), eval::contact_sheet(strategies, exposure),
                  {.exposure = exposure, .metadata = options.metadata});
}

void save_rates(const std::filesystem::path& file, const RenderOptions& options,
                const io::ImageMetadata& metadata)
{
    const FilmOptions& film = options.film;
    const SampleRates rates =
        options.sampling.rates
            ? *options.sampling.rates
            : SampleRates(film.width, film.height,
                          std::vector<std::int8_t>(static_cast<std::size_t>(film.width) *
                                                   static_cast<std::size_t>(film.height)));
    if (has_extension(file, ".exr")) {
        io::write_rates(file, rates, metadata);
        return;
    }
    eval::ErrorMap map{.width = rates.width(), .height = rates.height(), .values = {}};
    for (const std::int8_t exponent : rates.exponents()) {
        map.values.push_back(SampleRates::to_rate(exponent));
    }
    const float most = SampleRates::to_rate(SampleRates::max_exponent);
    io::write_png(file, eval::false_color(map, {.scale = most, .title = "samples per round"}),
                  {.metadata = metadata});
}

namespace {

/// Returns all files of images, strategy images included.
std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments)
{
    std::vector<std::filesystem::path> files = arguments.outputs;
    if (arguments.strategies) {
        const auto more = arguments.strategies->both();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

/// Checks that a part file is no device or pipe, as it is read back.
void check_part_file(const std::filesystem::path& file)
{
    std::error_code missing;
    if (std::filesystem::exists(file, missing) &&
        !std::filesystem::is_regular_file(file, missing)) {
        throw Error(ErrorCode::output,
                    fmt::format("--part \"{}\": cannot write: a part is read again, and this is "
                                "not a regular file",
                                file.string()));
    }
}

/// Checks `file`, which `job` may have named by `option`.
void check_file_of_job(const JobSource& job, std::string_view option,
                       const std::filesystem::path& file)
{
    if (is_standard_output(file)) {
        return;
    }
    const bool names = is_among(job.outputs, option);
    const bool names_default = job.names_default && option == "--output";
    if (names && !is_below(file, job.file.parent_path())) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: {} \"{}\": a job writes only into its folder; name other "
                                "files on the command line",
                                job.file.string(), option, file.string()));
    }
    std::error_code ignored;
    // A part is not replaced but continued.
    if ((names || names_default) && option != "--part" && std::filesystem::exists(file, ignored) &&
        !is_file_of_ours(file)) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: a job names it, but it is not a file that "
                                "bdpt wrote; remove it, or name files with {}",
                                file.string(), option));
    }
}

}  // namespace

void check_files_of_job(const RenderArguments& arguments)
{
    for_each_written_file(arguments,
                          [&](std::string_view option, const std::filesystem::path& file) {
                              if (arguments.job) {
                                  check_file_of_job(*arguments.job, option, file);
                              }
                          });
}

std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                               const FileSet& inputs)
{
    if (arguments.outputs.empty() && !arguments.part) {
        throw OptionError(arguments.sequence
                              ? "--output is required for several images, like -o out.####.png"
                              : "--output is required for a scene from the standard input");
    }
    check_files_of_job(arguments);
    check_outputs(arguments.outputs, inputs);
    FileSet outputs(arguments.outputs);
    std::vector<std::filesystem::path> written = all_image_files(arguments);
    if (arguments.strategies) {
        check_strategy_files(*arguments.strategies, inputs, outputs);
        outputs.add(arguments.strategies->both());
    }
    if (arguments.saved_rates) {
        written.push_back(*arguments.saved_rates);
        check_outputs(written, inputs);
        outputs.add(*arguments.saved_rates);
    }
    if (arguments.part) {
        check_output("--part", arguments.part->file, inputs, outputs);
        check_part_file(arguments.part->file);
        outputs.add(arguments.part->file);
        written.push_back(arguments.part->file);
    }
    if (arguments.stats) {
        check_output("--stats", *arguments.stats, inputs, outputs);
        written.push_back(*arguments.stats);
    }
    return written;
}

}  // namespace bdpt::job
