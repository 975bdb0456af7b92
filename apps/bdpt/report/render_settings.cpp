#include "report/render_settings.h"

#include <bdpt/options/option_fields.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/version.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "options/groups/film_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/values/view.h"
#include "report/values.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

ordered_json view_json(const CameraDesc& camera)
{
    ordered_json view{{"camera", camera.name}};
    if (camera.projection == Projection::orthographic) {
        view["projection"] = "orthographic";
        view["vertical_extent"] = camera.vertical_extent;
        return view;
    }
    view["projection"] = "perspective";
    view["vertical_fov_degrees"] = degrees(camera.vertical_fov);
    if (camera.lens_radius > 0.0f) {
        view["lens_radius"] = camera.lens_radius;
        view["focus_distance"] = camera.focus_distance;
    }
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
    settings["sampler"] = to_name(options.sampling.sampler);
    settings["seed"] = options.sampling.seed;
    if (options.sampling.rates) {
        settings["rates"] = rates_json(arguments);
    }
    settings["isa"] = isa_name(stage.scene.isa());
    settings.update(view_json(stage.camera));
    settings["environment"] = named(arguments, stage.environment_name);
    if (arguments.environment_change.rotation != 0.0) {
        settings["environment_rotation_degrees"] = arguments.environment_change.rotation;
    }
    if (arguments.environment_change.intensity != 1.0f) {
        settings["environment_intensity"] = arguments.environment_change.intensity;
    }
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
    if (arguments.light_exposure) {
        settings["light_exposure"] = *arguments.light_exposure;
    }
    if (options.film.aovs.contains(Aov::shadow)) {
        settings["ground"] = "shadow";
        const Vec3 lowest(to_file(stage.scene.bounds().min, stage.scene.description().origin));
        settings["ground_height"] = options.film.ground_height.value_or(lowest.y);
    }
    if (arguments.texture_filter == TextureFilter::mip_mapped) {
        settings["texture_filter"] = "mip";
    }
    if (arguments.contacts != ContactKind::automatic) {
        settings["contacts"] = arguments.contacts == ContactKind::bonded ? "bonded" : "air";
    }
    const FilterOptions& filter = options.film.filter;
    settings["filter"] = to_name(filter.kind);
    settings["filter_radius"] = filter.radius.value_or(default_radius(filter.kind));
    if (options.film.crop) {
        const PixelRect& crop = *options.film.crop;
        settings["crop"] = {crop.x0, crop.y0, crop.x1, crop.y1};
    }
    if (std::isfinite(options.film.clamp)) {
        settings["clamp"] = options.film.clamp;
    }
    const auto add_word = [&settings](const char* name, const std::optional<std::string>& word) {
        if (word) {
            settings[name] = *word;
        }
    };
    add_word("scene", arguments.scene.scene);
    add_word("variant", arguments.scene.variant);
    add_word("animation", arguments.scene.animation);
    if (arguments.scene.time) {
        settings["frame_time"] = *arguments.scene.time;
    }
    if (arguments.scene.shutter) {
        settings["shutter"] = {arguments.scene.shutter->open, arguments.scene.shutter->close};
    }
    if (arguments.sequence && arguments.sequence_view->frame) {
        settings["frame"] = *arguments.sequence_view->frame;
        if (arguments.sequence->fps > 0.0) {
            settings["fps"] = arguments.sequence->fps;
        }
        if (arguments.sequence->orbit > 0) {
            settings["orbit"] = arguments.sequence->orbit;
        }
    }
    if (arguments.goal.samples) {
        settings["spp"] = *arguments.goal.samples;
    }
    if (arguments.goal.noise) {
        settings["noise_goal"] = *arguments.goal.noise;
    }
    if (std::isfinite(arguments.goal.seconds)) {
        settings["time_limit_seconds"] = arguments.goal.seconds;
    }
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
    metadata.xmp = stage.xmp;
    return metadata;
}

}  // namespace bdpt::app
