#include "options/render_arguments.h"

#include <bdpt/options/option_text.h>
#include <bdpt/part/sample_rates.h>

#include <array>
#include <utility>

#include "machine/machine_limits.h"
#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

constexpr OptionUses of_render{.plan_render = true, .python_render = true};
constexpr OptionUses of_load{.plan_render = true, .python_load = true};
/// The options of load() are the defaults of render().
constexpr OptionUses of_view{.plan_render = true, .python_load = true, .python_render = true};
constexpr OptionUses of_save{.plan_merge = true, .python_save = true};

void add_how(OptionList& options, RenderRequest& request)
{
    RenderArguments& arguments = request.arguments;
    RenderOptions& render = arguments.options;
    options.section("How to render", of_render);
    constexpr std::int64_t max_samples = std::int64_t{1} << 31;
    options.add(
        "--spp", "N",
        "Samples per pixel. Default: 64; 8 to 64, by its size, for a denoised picture alone",
        request.spp, whole_number(1, max_samples));
    add_size_option(options, request,
                    "Image size. Default: the largest with the camera's aspect ratio within "
                    "1280x720");
    options
        .add_flag("--adaptive",
                  "Adaptive sampling: 1/4 to 4 times --spp samples, by the noise in a test render "
                  "of 8 samples per pixel; --spp is the mean, a multiple of 8. Unbiased. Not for "
                  "lt and vcm. By default, --integrator auto gives pixels 1/2 to 2 times "
                  "--spp where that helps; --adaptive=false gives all equally many",
                  request.adaptive, on_or_off(Adaptivity::on, Adaptivity::off))
        .default_is_chosen = true;
    options
        .add("--rates", "FILE",
             "Adaptive sampling by an .exr of --save-rates, without a test render",
             request.rates.file, file_path())
        .uses.plan_render = false;  // plans store it in their folder
    add_fields(options, render.sampling);
    options.section("How to render", {.python_render = true});
    add_fields(options, render.system);
    options.section("How to render", of_render);
    const auto isas = make_choices(all_isas, isa_name);
    options
        .add("--isa", "sse2|sse4.2|avx|avx2|avx512|native",
             "Instruction set of Embree. Images are bit-identical only for equal sets: on a render "
             "farm, choose one that all machines have. Default: the best of this CPU",
             arguments.isa, isas.type())
        .uses = of_load;
    options
        .add("--samples", "A:B",
             "Render samples A to B - 1 of each pixel: one part of a distributed render, which has "
             "--spp samples in all",
             request.samples, sample_range())
        .uses.plan_render = false;
}

void add_image_output(OptionList& options, RenderRequest& request)
{
    RenderArguments& arguments = request.arguments;
    options.section("Output", of_save);
    options
        .add_repeated(
            "-o,--output", "FILE",
            "An image: .exr or .hdr (linear radiance), .png, .jpg or .webp (tone-mapped); exr:-, "
            "png:- etc. write to standard output. May be repeated. Default of bdpt render without "
            "--part: the scene's name with .png, in the working directory",
            arguments.outputs, file_path(standard_output_names()))
        .uses = {.stated_in = StatedIn::own_folder};
    add_display_options(options, arguments.display);
    add_denoise_options(options, arguments.denoise);
    add_half_option(options, arguments.exr);
    options
        .add_flag("--float", "Store .exr as 32-bit floats (default)", arguments.exr.channel_type,
                  on_or_off(io::ExrChannelType::single_float, io::ExrChannelType::half_float))
        .uses = {};
    add_tiled_option(options, arguments.exr);
    options
        .add_flag("--full-paths", "Store full paths of the scene and other files in image metadata",
                  arguments.path_names, on_or_off(PathNames::paths, PathNames::files))
        .uses = {.plan_render = true};
    add_quiet_option(options, arguments.printed);
    options
        .add_flag("-v,--verbose", "Print also how the render was set up",
                  arguments.printed.verbosity, on_or_off(Verbosity::verbose, Verbosity::normal))
        .uses = {.stated_in = StatedIn::command_line};
    add_json_option(options, arguments.printed,
                    "Print one JSON object per line on stdout: start, progress, note, warning, "
                    "done, error. With --quiet only done and error");
}

/// Adds options of a single rendering process, not of the render as such.
void add_process_options(OptionList& options, RenderRequest& request)
{
    RenderArguments& arguments = request.arguments;
    options.section("How to render", {.python_render = true});
    add_time_option(options, request,
                    "Time of loading and rendering, like 90s, 2m or 1.5h; at least one pass is "
                    "rendered. Without --spp the only limit");
    options.add("--noise", "N%",
                "Stop at this noise, like 2%: the relative standard error that 95 % of all tiles "
                "of 16 x 16 pixels do not exceed. Checked after 16, 24, 32, 48, 64, ... samples "
                "per pixel. The render ends at the first limit of --noise, --spp (here 65536 by "
                "default) and --time",
                arguments.goal.noise, noise_level());
    options.section("Output");
    options
        .add("--stats", "FILE", "Write ray and path counts and timings to this .json file",
             arguments.stats, file_path({"-"}))
        .uses.stated_in = StatedIn::own_folder;
    options
        .add("--save-rates", "FILE",
             "Write the samples of each pixel as multiples of --spp, of --integrator auto or "
             "--adaptive: .exr for --rates, or .png in false colours",
             arguments.saved_rates,
             file_named({".exr", ".png"}, "a file name that ends in .exr or .png"))
        .uses.stated_in = StatedIn::own_folder;
    add_strategy_options(options, request.strategies);
    add_part_options(options, request.part);
    options
        .add("--display", "HOST[:PORT]",
             "Show the render in progress in the image viewer tev at this address. Default port: "
             "14158",
             arguments.viewer,
             parsed_by([](const std::string& text) { return parse_address(text); },
                       "HOST or HOST:PORT, like localhost:14158"))
        .uses.stated_in = StatedIn::command_line;
    options
        .add("--save-job", "FILE",
             "Write these options to this .json file, a job, instead of rendering. bdpt render "
             "takes a job in place of a scene; further options override the job's",
             request.saved_job, file_named({".json"}, "a file name that ends in .json"))
        .uses.stated_in = StatedIn::command_line;
}

/// Returns the job that gave some of `options`, if any.
std::optional<JobSource> find_job(const OptionList& options)
{
    std::optional<JobSource> job;
    for (const Option& option : options.all()) {
        if (option.given() && !option.job.empty()) {
            job = job.value_or(JobSource{.file = option.job});
            if (option.uses.stated_in == StatedIn::own_folder) {
                job->outputs.push_back(option.name());
            }
        }
    }
    return job;
}

/// Returns the goal of the render.
Goal choose_goal(const RenderRequest& request)
{
    Goal goal = request.arguments.goal;
    goal.seconds = request.seconds.value_or(goal.seconds);
    if (request.samples) {
        goal.samples = request.samples->end - request.samples->begin;
    } else if (request.spp || !request.seconds) {
        constexpr std::int64_t enough = 65536;  // limit where noise does not converge
        goal.samples = request.spp.value_or(goal.noise ? enough : SampleRange{}.end);
    }
    return goal;
}

/// Tests whether rates of samples were asked for.
bool takes_rates(const RenderRequest& request)
{
    return request.adaptive == Adaptivity::on || request.rates.file;
}

/// Tests whether the pilot of the integrator may choose rates.
bool may_adapt(const RenderRequest& request, const RenderArguments& arguments)
{
    return request.adaptive == Adaptivity::automatic && !takes_rates(request) &&
           arguments.options.integrator == IntegratorKind::automatic &&
           SampleRates::fit(arguments.samples);
}

/// Tests whether one image is rendered, and no option sets its samples or another limit.
bool may_take_few(const RenderRequest& request, const RenderArguments& arguments)
{
    return !request.spp && !request.samples && !request.seconds && !arguments.goal.noise &&
           !takes_rates(request) && !arguments.part && !arguments.sequence;
}

/// Returns the number of samples of the whole render, as far as it is known.
std::int64_t plan_samples(const RenderRequest& request, const Goal& goal)
{
    if (goal.noise) {
        return 0;
    }
    const bool has_end = request.samples || !request.seconds;
    return request.spp.value_or(has_end ? SamplingOptions{}.planned_samples : 0);
}

SampleRange choose_samples(const RenderRequest& request, const Goal& goal)
{
    // With --time alone, more samples than anyone has time for.
    constexpr std::int64_t no_limit = std::int64_t{1} << 30;
    const SampleRange samples =
        request.samples.value_or(SampleRange{.begin = 0, .end = goal.samples.value_or(no_limit)});
    if (takes_rates(request) &&
        (samples.begin % SampleRates::group != 0 || samples.end % SampleRates::group != 0)) {
        reject(request.samples ? "--samples" : "--spp",
               request.samples ? option_text(samples) : option_text(samples.end),
               "multiples of 8 with --adaptive and --rates");
    }
    return samples;
}

void check_combinations(const OptionList& options, const std::optional<std::string>& camera)
{
    static constexpr std::array conflicts{
        Conflict{"--noise", "--samples", "a range of samples cannot decide when to stop"},
        Conflict{"--adaptive", "--rates"}, Conflict{"--half", "--float"},
        Conflict{"--quiet", "--verbose"}};
    check(conflicts, options);
    check_camera_options(options, camera);
    check_medium_options(options);
}

}  // namespace

void add_scene_file(OptionList& options, RenderRequest& request)
{
    options.section("");
    options
        .add("file", "FILE", "The scene: .gltf or .glb; - is the standard input",
             request.arguments.file, file_path({"-"}))
        .required = true;
}

void add_size_option(OptionList& options, RenderRequest& request, std::string help)
{
    options.add("--size", "WxH", std::move(help), request.arguments.size, image_size())
        .uses.python_load = true;
}

void add_time_option(OptionList& options, RenderRequest& request, std::string help)
{
    options.add("--time", "TIME", std::move(help), request.seconds, duration());
}

void add_view_options(OptionList& options, RenderRequest& request)
{
    RenderArguments& arguments = request.arguments;
    options.section("What to render", of_load);
    add_scene_options(options, arguments.scene, request.max_memory);
    options.section("What to render", of_view);
    add_camera_options(options, arguments.camera, arguments.view);
    options.section("What to render", of_load);
    options
        .add("--env", "FILE|none|default|object|studio",
             "Environment map: an equirectangular .exr, .hdr, .tif, .png or .jpg, none, default (a "
             "soft sky, which rooms without light get), object (a key and a rim light, which "
             "objects without light get), or studio (soft boxes, for products). Replaces the "
             "file's",
             arguments.environment, file_path({"none", "default", "object", "studio", "-"}))
        .uses.plan_render = false;  // plans store files separately
    add_environment_options(options, arguments.environment_change);
    add_fog_options(options, request.fog);
    add_volume_options(options, request.volume);
    const Choices<TextureFilter> filters{
        {{"bilinear", TextureFilter::bilinear}, {"mip", TextureFilter::mip_mapped}}};
    add_choice(options, "--texture-filter",
               "Texture filter: bilinear (default) or mip (mip mapping: faster for large "
               "textures, but blurs them in magnifying mirrors and lenses)",
               arguments.texture_filter, filters);
    const Choices<ContactKind> kinds{{{"auto", ContactKind::automatic},
                                      {"air", ContactKind::air},
                                      {"bonded", ContactKind::bonded}}};
    add_choice(options, "--contacts",
               "Between bodies of glass that touch: air (a thin film: two boundaries), bonded (one "
               "boundary) or auto (default: bonded if their indices of refraction differ, like "
               "those of a liquid and its glass, else air)",
               arguments.contacts, kinds);
    options.section("What to render", of_view);
    add_lens_options(options, arguments.lens);
}

void add_plannable_options(OptionList& options, RenderRequest& request)
{
    RenderOptions& render = request.arguments.options;
    add_scene_file(options, request);
    add_image_output(options, request);
    add_how(options, request);
    add_transport_options(options, render, request.only);
    options.section("Film", of_render);
    add_ground_option(options, request.ground);
    add_fields(options, render.film);
    add_view_options(options, request);
}

void add_render_options(OptionList& options, RenderRequest& request)
{
    add_plannable_options(options, request);
    options.section("");
    options
        .add_repeated(
            "others", "FILE",
            "More scenes, rendered one after the other; {name} in output names becomes the scene's "
            "name",
            request.others, file_path())
        .uses.stated_in = StatedIn::command_line;
    add_process_options(options, request);
    add_sequence_options(options, request.sequence);
}

RenderArguments checked(const RenderRequest& request, const OptionList& options)
{
    RenderArguments result = request.arguments;
    result.job = find_job(options);
    result.part = checked(request.part, options);
    result.sequence = checked(request.sequence, options);
    check_combinations(options, result.camera);
    result.goal = choose_goal(request);
    result.samples = choose_samples(request, result.goal);
    result.options.sampling.planned_samples = plan_samples(request, result.goal);
    if (takes_rates(request)) {
        result.rates = request.rates;
    }
    result.options = with_transport(result.options, request.only, options);
    result.may_adapt = may_adapt(request, result);
    if (result.saved_rates && !result.rates && !result.may_adapt) {
        throw OptionError(
            "--save-rates: all pixels get equally many samples here; --adaptive gives them "
            "different ones");
    }
    if (!result.options.film.aovs.empty() && !writes_exr(result.outputs) && !result.part) {
        throw OptionError("--aov needs an .exr file among the outputs, or --part");
    }
    result.memory = scene_memory_limit(request.max_memory);
    result.scene.limits.memory_bytes = result.memory.bytes;
    if (options.given("--fog")) {
        result.fog = request.fog;
    }
    if (options.given("--volume")) {
        result.volume = request.volume;
    }
    check_transparency(result.display, result.outputs);
    if (result.display.backdrop) {
        result.options.transport.background = Background::none;
        result.options.film.aovs.insert(Aov::alpha);
    }
    result.options.film = with_ground(request.ground, result.options.film, options);
    result.may_add_ground = request.ground == Ground::automatic && !result.display.backdrop &&
                            !result.fog && !result.volume && !result.part;
    if (result.denoise.is_asked()) {
        AovSet& aovs = result.options.film.aovs;
        for (const Aov guide : missing_guides(aovs, result.display.backdrop)) {
            aovs.insert(guide);
        }
        if (result.sequence && !options.given("--same-noise")) {
            result.sequence->noise = SequenceNoise::same;
        }
    }
    result.strategies = checked(request.strategies, result.options, options);
    result.may_take_few = may_take_few(request, result) && !result.strategies;
    std::vector<std::filesystem::path> written = result.outputs;
    written.push_back(result.stats.value_or(""));
    check_pipes(std::array{result.file, std::filesystem::path(result.environment.value_or(""))},
                written, result.printed.format);
    return result;
}

RenderArguments render_arguments(const std::vector<std::string>& words)
{
    RenderOptionList options;
    give_words(words, options.list);
    return checked(options.request, options.list);
}

bool is_file_of_environment(const std::string& environment)
{
    return !is_among(named_environments, environment);
}

void add_part_options(OptionList& options, PartChoice& part)
{
    options
        .add("--part", "FILE",
             "Checkpoint file (.exr): written while rendering; if it exists, the render resumes "
             "from it (after a crash, or with more --spp). bdpt merge reads it, too. Without -o "
             "only this file is written",
             part.file, file_named({".exr"}, "a file name that ends in .exr, best in .part.exr"))
        .uses.stated_in = StatedIn::own_folder;
    options
        .add_flag("--restart", "Replace the file of --part instead of resuming from it",
                  part.existing, on_or_off(ExistingPart::restart, ExistingPart::go_on))
        .uses.stated_in = StatedIn::programs;
    options
        .add("--plan", "FILE",
             "Render one task of this plan (bdpt plan), which sets all but --threads, "
             "--max-memory, --stats, --ktx-library, --allow-folder, --restart, --quiet, --verbose "
             "and "
             "--json",
             part.plan, any_text())
        .uses.stated_in = StatedIn::command_line;
    options
        .add("--task", "N|env:NAME",
             "Task of --plan, counted from 0, or the environment variable that holds its number",
             part.task, any_text())
        .uses.stated_in = StatedIn::command_line;
}

std::optional<PartChoice> checked(const PartChoice& part, const OptionList& options)
{
    static constexpr std::array needs{Need{"--task", "--plan"}, Need{"--restart", "--part"}};
    if (options.find("--part") != nullptr) {  // the --restart of bdpt plan is a different option
        check(needs, options);
    }
    return options.given("--part") ? std::optional(part) : std::nullopt;
}

void add_half_option(OptionList& options, ExrFormat& exr)
{
    options.add_flag("--half", "Store .exr as 16-bit floats", exr.channel_type,
                     on_or_off(io::ExrChannelType::half_float, io::ExrChannelType::single_float));
}

void add_tiled_option(OptionList& options, ExrFormat& exr)
{
    options.add_flag("--tiled", "Store .exr in tiles, for programs that read parts of it",
                     exr.storage, on_or_off(io::ExrStorage::tiles, io::ExrStorage::scanlines));
}

void add_quiet_option(OptionList& options, Printed& printed, std::string help)
{
    options
        .add_flag("-q,--quiet", std::move(help), printed.verbosity,
                  on_or_off(Verbosity::quiet, Verbosity::normal))
        .uses = {.stated_in = StatedIn::command_line};
}

void add_json_option(OptionList& options, Printed& printed, std::string help)
{
    options
        .add_flag("--json", std::move(help), printed.format, on_or_off(Format::json, Format::text))
        .uses = {.stated_in = StatedIn::command_line};
}

}  // namespace bdpt::job
