#include "stage/prepared_scene.h"

#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/io/gltf.h>
#include <bdpt/io/part_file.h>
#include <bdpt/light/light_meter.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "options/groups/image_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/groups/view_arguments.h"
#include "options/output_files.h"

namespace bdpt::job {

Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                             const RenderArguments& image)
{
    if (!image.sequence_view) {
        return first;
    }
    const SequenceView& view = *image.sequence_view;
    Viewpoint result = view.camera ? viewpoint(stage, *view.camera, image) : first;
    if (view.turn) {
        const Bounds& bounds = stage.scene.bounds();
        const Vec3 middle = 0.5f * (bounds.min + bounds.max);
        // A framed view has room for the whole turn around the middle.
        const bool is_framed =
            !view.camera && !image.view.from && !image.view.look_at && first.is_framed;
        std::optional<Vec3> target;
        if (image.view.look_at) {
            target = to_world(*image.view.look_at, stage.scene.description().origin);
        }
        const Vec3 center = is_framed ? middle : orbit_center(result.camera, target, middle);
        result.camera = orbited(std::move(result.camera), center, static_cast<float>(*view.turn));
    }
    return result;
}

Scene with_turned_environment(const Scene& still, double angle)
{
    for (const LightDesc& light : still.description().lights) {
        if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
            return still.with_environment(turned(*environment, static_cast<float>(angle)));
        }
    }
    return still.edited(still.description());
}

namespace fs = std::filesystem;

std::vector<fs::path> input_files(const RenderArguments& arguments)
{
    std::vector<fs::path> files{arguments.file};
    const std::string environment = arguments.environment.value_or("none");
    if (is_file_of_environment(environment)) {
        files.emplace_back(environment);
    }
    if (arguments.volume) {
        files.push_back(arguments.volume->file);
    }
    if (arguments.rates && arguments.rates->file) {
        files.push_back(*arguments.rates->file);
    }
    if (arguments.part && arguments.part->plan) {
        files.push_back(*arguments.part->plan);
    }
    if (arguments.denoise.library) {
        files.push_back(*arguments.denoise.library);
    }
    if (arguments.scene.ktx_library) {
        files.push_back(*arguments.scene.ktx_library);
    }
    if (arguments.job) {
        files.push_back(arguments.job->file);
    }
    if (arguments.display.backdrop && !arguments.display.backdrop->photo.empty()) {
        files.push_back(arguments.display.backdrop->photo);
    }
    std::erase(files, "-");  // the standard input, which no output overwrites
    return files;
}

std::vector<fs::path> input_files(const RenderArguments& arguments, const PreparedScene& stage)
{
    std::vector<fs::path> files = input_files(arguments);
    files.insert(files.end(), stage.files.begin(), stage.files.end());
    return files;
}

std::vector<fs::path> named_files(const RenderArguments& arguments,
                                  std::span<const fs::path> outputs)
{
    const bool replaces = std::any_of(outputs.begin(), outputs.end(), [](const fs::path& output) {
        std::error_code ignored;
        return fs::exists(output, ignored);
    });
    if (!replaces || arguments.file == "-") {
        return {};
    }
    try {
        return io::read_gltf_files(arguments.file, arguments.scene.limits,
                                   arguments.scene.allowed_folders);
    } catch (const Error&) {
        return {};  // what is wrong is said when the scene is loaded
    }
}

namespace {

RenderOptions options_for(const RenderArguments& arguments, const PreparedScene& stage,
                          Console& console)
{
    RenderOptions options = arguments.options;
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    options.sampling.samples = arguments.samples;
    if (arguments.strategies) {
        const StrategyDepth depth = strategy_depth(*arguments.strategies, options, stage.camera);
        options.bidirectional.strategy_depth = depth.edges;
        if (depth.warning) {
            console.warning(*depth.warning);
        }
    }
    return options;
}

std::shared_ptr<const SampleRates> prepare_rates(const RenderArguments& arguments,
                                                 const PreparedScene& stage, Console& console)
{
    if (!arguments.rates->file) {
        const auto start = std::chrono::steady_clock::now();
        auto rates = std::make_shared<const SampleRates>(
            sample_rates(stage.scene, stage.camera, arguments.options));
        console.verbose(
            {"adaptive",
             fmt::format("noisy pixels get more samples and others fewer: {} to {} times --spp, "
                         "{:.3f} on average, by a test render of {} samples in {:.1f} s",
                         rates->least(), rates->greatest(), rates->mean(), rate_pilot_samples,
                         seconds_since(start))});
        return rates;
    }
    const std::filesystem::path& file = *arguments.rates->file;
    auto rates = std::make_shared<const SampleRates>(io::read_rates(file));
    if (rates->width() != stage.size.width || rates->height() != stage.size.height) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}: rates of {}x{} pixels, but the image has {}x{}", file.string(),
                        rates->width(), rates->height(), stage.size.width, stage.size.height));
    }
    return rates;
}

/// Throws `Error` if light paths or images of strategies do not fit into the memory that the scene
/// and the film leave. Their numbers must not depend on it: a machine with less memory, or a busier
/// one, would render other bits.
void check_memory(const PreparedScene& stage, const RenderOptions& options)
{
    stage.memory.check(fmt::format("the set of light paths for {}x{} pixels (--light-path-memory)",
                                   options.film.width, options.film.height),
                       light_path_bytes(options));
    stage.memory.check("the set of strategy images (--strategy-depth)",
                       strategy_image_bytes(options, stage.camera));
}

/// Tests whether the camera is outside of the visible scene, most of which then has the same light.
bool is_seen_from_outside(const PreparedScene& stage)
{
    const Bounds& bounds = stage.scene.bounds();
    const Vec3 eye(stage.camera.world_from_camera[3]);
    return glm::any(glm::lessThan(eye, bounds.min)) || glm::any(glm::greaterThan(eye, bounds.max));
}

/// Returns the size of the image or, without --size, the largest that it may get.
Size largest_size(const RenderArguments& arguments)
{
    return arguments.size.value_or(default_size(std::nullopt));
}

}  // namespace

std::uint64_t image_cache_bytes(const RenderArguments& arguments)
{
    constexpr std::uint64_t most = std::uint64_t{2} << 30U;
    return std::min(most, arguments.memory.bytes / 4);
}

void tell_findings(Console& console, const PreparedScene& stage)
{
    for (const Note& note : stage.notes) {
        console.note(note, Repeat::never);
    }
    for (const std::string& warning : stage.warnings) {
        console.warning(warning);
    }
}

void tell_of_no_effect(Console& console, const RenderArguments& arguments,
                       const PreparedScene& stage)
{
    if (arguments.options.film.aovs.contains(Aov::shadow) && !arguments.display.backdrop &&
        !has_environment(stage)) {
        console.note(
            Note{"ground_not_visible",
                 "the shadow on the ground is not visible: there is no environment behind it "
                 "(--env, or --background)"},
            Repeat::never);
    }
    const auto writes = [&arguments](const auto& is_it) {
        return std::any_of(arguments.outputs.begin(), arguments.outputs.end(), is_it);
    };
    const auto tell = [&console](std::string_view option, std::string_view types) {
        console.note({"no_effect", fmt::format("{} has no effect: no output is {}", option, types)},
                     Repeat::never);
    };
    if (!arguments.strategies && !writes_exr(arguments.outputs)) {
        if (arguments.exr.channel_type == io::ExrChannelType::half_float) {
            tell("--half", ".exr");
        }
        if (arguments.exr.storage == io::ExrStorage::tiles) {
            tell("--tiled", ".exr");
        }
    }
    if (arguments.display.type == TexelType::unorm16 &&
        !writes([](const auto& output) { return find_type(output) == ImageType::png; })) {
        tell("--png-bits 16", ".png");
    }
    if (arguments.display.curve != io::ToneCurve::filmic && !writes(is_for_screens)) {
        tell("--tone-map", ".png, .jpg or .webp");
    }
    if (arguments.denoise.library && !needs_denoiser(arguments.denoise, arguments.outputs)) {
        console.note(
            Note{"no_effect",
                 "--denoiser-library has no effect: no output is denoised (--denoise denoises "
                 "all images)"},
            Repeat::never);
    }
}

void spend_film(io::MemoryBudget& memory, const RenderOptions& options, const Size& size)
{
    memory.spend(fmt::format("the film of {}x{} pixels", size.width, size.height),
                 film_bytes(options, size));
}

void spend_ground(io::MemoryBudget& memory, const RenderArguments& arguments)
{
    const Size size = largest_size(arguments);
    RenderOptions more = arguments.options;
    more.film.aovs.insert(Aov::shadow);
    memory.spend(fmt::format("the shadow on the ground of {}x{} pixels", size.width, size.height),
                 film_bytes(more, size) - film_bytes(arguments.options, size));
}

std::optional<std::vector<Aov>> spend_guides(io::MemoryBudget& memory,
                                             const RenderArguments& arguments)
{
    RenderOptions options = arguments.options;
    std::vector<Aov> guides;
    if (!arguments.part) {
        guides = missing_guides(options.film.aovs, arguments.display.backdrop);
    }
    const Size size = largest_size(arguments);
    const std::uint64_t before = film_bytes(options, size);
    for (const Aov guide : guides) {
        options.film.aovs.insert(guide);
    }
    const std::uint64_t more = film_bytes(options, size) - before;
    if (more + denoiser_bytes(options, size) > memory.left()) {
        return std::nullopt;
    }
    memory.spend("the layers that guide the denoiser", more);
    return guides;
}

PreparedScene prepare_with_progress(RenderArguments arguments, Console& console)
{
    const auto start = std::chrono::steady_clock::now();
    arguments.scene.on_progress = [&console, start](const io::LoadProgress& progress) {
        const double passed = seconds_since(start);
        constexpr double report_threshold = 1.0;  // [s]
        if (passed < report_threshold) {
            return;
        }
        const double done =
            static_cast<double>(progress.images_done) / static_cast<double>(progress.images_total);
        console.task({.fraction = done,
                      .seconds = passed,
                      .seconds_left = passed * (1.0 - done) / done,
                      .activity = fmt::format("loading textures, {}/{}", progress.images_done,
                                              progress.images_total)});
    };
    return prepare_scene(arguments);
}

PreparedScene prepare_within_memory(const RenderArguments& asked, Console& console)
{
    RenderArguments arguments = asked;
    arguments.scene.memory = std::make_shared<io::MemoryBudget>(asked.memory);
    spend_film(*arguments.scene.memory, asked.options, largest_size(asked));
    if (asked.scene.images) {
        arguments.scene.memory->spend("the images of other frames", image_cache_bytes(asked));
    }
    return prepare_with_progress(arguments, console);
}

RenderArguments with_choice(RenderArguments arguments, const PreparedScene& stage, Console& console,
                            const std::stop_token& abandon)
{
    const IntegratorChoice choice = choose_integrator(
        stage.scene, stage.camera, options_for(arguments, stage, console), abandon);
    if (abandon.stop_requested()) {
        return arguments;
    }
    constexpr double worth_telling = 0.01;
    if (choice.unseen_light >= worth_telling) {
        console.warning(fmt::format(
            "about {:.2g} % of the light is missing: only --integrator vcm can sample it (caustics "
            "of the sun or of point lights, seen in mirrors or through glass)",
            100.0 * choice.unseen_light));
    }
    arguments.options = arguments.may_adapt ? with_rates(choice) : choice.options;
    check_memory(stage, arguments.options);
    if (arguments.may_adapt && arguments.options.sampling.rates) {
        console.verbose(
            {"adaptive",
             fmt::format("noisy pixels get more samples and others fewer: {} to {} times --spp "
                         "(--adaptive=false: all the same)",
                         choice.rates->least(), choice.rates->greatest())});
    } else if (arguments.rates && !arguments.options.sampling.rates) {
        arguments.options.sampling.rates = prepare_rates(arguments, stage, console);
    }
    return arguments;
}

bool meters_light(const RenderArguments& arguments, const PreparedScene& stage)
{
    const std::optional<Exposure>& exposure = arguments.display.exposure;
    if (arguments.display.backdrop || (arguments.sequence && arguments.sequence->frames)) {
        return true;
    }
    return exposure ? exposure->base == ExposureBase::light
                    : has_environment(stage) && is_seen_from_outside(stage);
}

std::optional<float> metered_exposure(const PreparedScene& stage, RenderArguments arguments)
{
    arguments.size.reset();
    const Viewpoint seen = viewpoint(stage, arguments);
    return metered_exposure(stage.scene, seen.camera, seen.size);
}

std::optional<float> metered_exposure(const Scene& scene, const CameraDesc& camera,
                                      const Size& size)
{
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    return light_exposure(light_level(white_cards(scene, camera, {.aspect = aspect})));
}

double light_beyond_max_depth(const RenderArguments& arguments, const PreparedScene& stage)
{
    constexpr int direct_light = 2;  // [edges]
    constexpr double worth_telling = 0.01;
    if (arguments.options.transport.max_depth <= direct_light) {
        return 0.0;
    }
    const double share = bdpt::light_beyond_max_depth(stage.scene, stage.camera, arguments.options);
    return share >= worth_telling ? share : 0.0;
}

}  // namespace bdpt::job
