#include "options/render_arguments.h"

#include <bdpt/part/sample_rates.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr const char* render_examples = R"(Examples:
  bdpt render scene.gltf -o out.exr
  bdpt render scene.glb -o out.exr -o out.png --spp 256 --size 1920x1080
  bdpt render room.glb -o out.exr --time 90s --camera "Camera 2"
  bdpt render chair.glb -o out.png --background transparent --ground shadow
  bdpt render walk.glb -o out.png --animation run --frame-time 0.25
  bdpt render hall.glb -o out.exr --spp 4096 --part out.part.exr
  bdpt render lamp.glb -o lamp.exr --spp 1024 --adaptive
  bdpt render walk.glb -o walk.####.exr --frames 1:48 --fps 24
  bdpt render hall.glb -o out.png --volume smoke.vdb --volume-extinction 20
  bdpt render model.glb -o out.png --env sky.hdr --from 3,2,4 --look-at 0,1,0 --fov 40

A file without a camera is framed as a whole, one without light gets a soft sky (and a lamp, if it
is a closed room); a warning says so. Ctrl-C, or closing the terminal, finishes the current pass and
writes the image; a second Ctrl-C quits at once. With --part, SIGUSR1 writes a checkpoint, and what
was killed goes on when the same command runs again.

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 input not found, 4 invalid input,
5 unsupported feature, 6 output cannot be written, 7 out of memory or threads, 129 stopped by
SIGHUP, 130 by SIGINT, 143 by SIGTERM.)";

std::uint64_t to_seed(const std::string& word)
{
    std::uint64_t seed = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, seed);
    if (error != std::errc{} || stop != end) {
        reject("--seed", word, "a whole number from 0 to 2^64 - 1");
    }
    return seed;
}

Goal to_goal(const RenderWords& words)
{
    Goal goal;
    if (words.time) {
        const std::optional<double> seconds = parse_duration(*words.time);
        if (!seconds) {
            reject("--time", *words.time, "a time like 60s, 2m or 1.5h");
        }
        goal.seconds = *seconds;
    }
    goal.noise = to_noise(words.noise);
    if (const std::optional<SampleRange> range = sample_range(words.part)) {
        if (words.samples) {
            reject("--samples", *words.part.samples, "no --spp beside it");
        }
        if (words.noise) {
            reject("--noise", *words.noise, "no --samples beside it: a part does not decide");
        }
        goal.samples = range->end - range->begin;
    } else if (words.samples || !words.time) {
        constexpr std::int64_t enough = 65536;  // where noise never gets low
        goal.samples = words.samples.value_or(words.noise ? enough : SampleRange{}.end);
    }
    return goal;
}

SampleRange to_samples(const RenderWords& words, const Goal& goal)
{
    // With --time alone, more samples than anyone has time for.
    constexpr std::int64_t no_limit = std::int64_t{1} << 30;
    const SampleRange samples =
        sample_range(words.part)
            .value_or(SampleRange{.begin = 0, .end = goal.samples.value_or(no_limit)});
    const bool adaptive = words.rates.adaptive || words.rates.file;
    if (adaptive &&
        (samples.begin % SampleRates::group != 0 || samples.end % SampleRates::group != 0)) {
        const char* expected = "multiples of 8 with --adaptive and --rates";
        if (words.part.samples) {
            reject("--samples", *words.part.samples, expected);
        }
        reject("--spp", fmt::format("{}", samples.end), expected);
    }
    return samples;
}

std::optional<Vec3> to_point(const char* option, const std::optional<std::string>& word)
{
    if (!word) {
        return std::nullopt;
    }
    const std::optional<Vec3> point = parse_vec3(*word);
    if (!point) {
        reject(option, *word, "three numbers x,y,z");
    }
    return point;
}

ViewOverrides to_view(const RenderWords& words)
{
    ViewOverrides view;
    view.from = to_point("--from", words.from);
    view.look_at = to_point("--look-at", words.look_at);
    if (words.fov) {
        if (!(*words.fov > 0.0 && *words.fov < 180.0)) {
            reject("--fov", fmt::format("{}", *words.fov), "degrees between 0 and 180");
        }
        view.vertical_fov = static_cast<float>(*words.fov * std::numbers::pi / 180.0);
    }
    return view;
}

std::vector<std::string> isa_names()
{
    std::vector<std::string> names;
    for (const Isa isa : all_isas) {
        names.emplace_back(isa_name(isa));
    }
    return names;
}

/// The one of that name, which the parser has found.
Isa to_isa(const std::string& name)
{
    return *std::find_if(all_isas.begin(), all_isas.end(),
                         [&](Isa isa) { return isa_name(isa) == name; });
}

void add_how(CLI::App& command, RenderWords& words)
{
    const auto group = "How to render";
    constexpr std::int64_t most_samples = std::int64_t{1} << 31;
    command.add_option("--spp", words.samples, "Samples per pixel. Default: 64")
        ->check(whole_number(1, most_samples))
        ->type_name("N")
        ->group(group);
    command
        .add_option(
            "--size", words.size,
            "Image size. Default: the largest with the camera's aspect ratio within 1280x720")
        ->type_name("WxH")
        ->group(group);
    command
        .add_option("--sampler", words.sampler,
                    "Random numbers: sobol (default; Owen-scrambled, less noise, best with a power "
                    "of two as --spp) or independent")
        ->check(one_of({"sobol", "independent"}))
        ->type_name("sobol|independent")
        ->group(group);
    add_rates_options(command, words.rates, group);
    add_seed_and_threads(command, words, group);
    command
        .add_option(
            "--isa", words.isa,
            "Instruction set of Embree. Images are equal to the bit only for equal sets: on a "
            "render farm, choose one that all machines have. Default: the best of this CPU")
        ->check(one_of(isa_names()))
        ->type_name("sse2|sse4.2|avx|avx2|avx512|native")
        ->group(group);
}

void add_image_output(CLI::App& command, RenderWords& words)
{
    const auto group = "Output";
    command
        .add_option("-o,--output", words.outputs,
                    "An image, .exr (linear radiance) or .png (tone-mapped); exr:- and png:- are "
                    "the standard output. May be repeated. Required without --part")
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group(group);
    add_display_options(command, words.display, group);
    add_denoise_options(command, words.denoise, group);
    CLI::Option* half =
        command.add_flag("--half", words.half, "Store .exr as 16-bit floats")->group(group);
    command.add_flag("--float", words.single, "Store .exr as 32-bit floats (default)")
        ->excludes(half)
        ->group(group);
    command
        .add_flag("--tiled", words.tiled, "Store .exr in tiles, for programs that read parts of it")
        ->group(group);
    command.add_flag("-q,--quiet", words.quiet, "Print errors only")->group(group);
    command
        .add_flag("--json", words.json,
                  "Print one JSON object per line on stdout: start, progress, warning, done, "
                  "error. With --quiet only done and error")
        ->group(group);
}

/// What concerns one process that renders, and not the render as such.
void add_process_options(CLI::App& command, RenderWords& words)
{
    const auto group = "Output";
    command
        .add_option("--time", words.time,
                    "Time to render for, like 90s, 2m or 1.5h; without --spp no other limit")
        ->type_name("TIME")
        ->group("How to render");
    command
        .add_option(
            "--noise", words.noise,
            "Stop when the noise is that low, like 2%: the relative standard error that 95 "
            "% of all tiles of 16 x 16 pixels are not above. Looked at after 16, 24, 32, "
            "48, 64, ... samples per pixel. Of --spp (with this: 65536, if not given), --time "
            "and this what comes first counts")
        ->type_name("N%")
        ->group("How to render");
    command
        .add_option("--stats", words.stats,
                    "Write counts of rays and paths, and times, to this .json file")
        ->type_name("FILE")
        ->group(group);
    command
        .add_flag("--profile", words.profile,
                  "Profile the render by phase and pixel: printed, in --stats, and as .exr layer "
                  "time.Y (microseconds per sample). Does not change the image")
        ->group(group);
    add_save_rates_option(command, words.rates, group);
    add_strategy_options(command, words.strategies);
    add_part_options(command, words.part, group);
    command
        .add_option("--display", words.viewer,
                    "Show the render while it runs in the image viewer tev, which listens there. "
                    "Default port: 14158")
        ->type_name("HOST[:PORT]")
        ->group(group);
}

}  // namespace

std::optional<double> to_noise(const std::optional<std::string>& word)
{
    if (!word) {
        return std::nullopt;
    }
    const std::optional<double> noise = parse_share(*word);
    if (!noise) {
        reject("--noise", *word, "a relative error above 0% and up to 100%, like 2% or 0.02");
    }
    return noise;
}

void add_view_options(CLI::App& command, RenderWords& words)
{
    const auto group = "What to render";
    add_scene_options(command, words.scene, group);
    command
        .add_option("--camera", words.camera,
                    "Camera of the scene, or auto to frame all of it. Default: the first")
        ->type_name("NAME|INDEX|auto")
        ->group(group);
    command.add_option("--from", words.from, "Move the camera here [m]")
        ->type_name("X,Y,Z")
        ->group(group);
    command.add_option("--look-at", words.look_at, "Turn the camera to this point [m]")
        ->type_name("X,Y,Z")
        ->group(group);
    command.add_option("--fov", words.fov, "Vertical field of view [degrees]")
        ->type_name("DEG")
        ->group(group);
    command
        .add_option("--env", words.environment,
                    "Environment map: an equirectangular .exr, .hdr or .tif, none, or default (the "
                    "sky that scenes without light get). Replaces that of the file")
        ->type_name("FILE|none|default")
        ->group(group);
    add_environment_options(command, words.environment_change, group);
    add_fog_options(command, words.fog, group);
    add_volume_options(command, words.volume, group);
    command
        .add_option("--texture-filter", words.texture_filter,
                    "Texture filter: bilinear (default) or mip (mip maps: faster for large "
                    "textures, but blurs what mirrors and lenses magnify)")
        ->check(one_of({"bilinear", "mip"}))
        ->type_name("bilinear|mip")
        ->group(group);
    add_lens_options(command, words.lens);
}

void add_seed_and_threads(CLI::App& command, RenderWords& words, const char* group)
{
    command.add_option("--seed", words.seed, "Seed of the random numbers. Default: 0")
        ->type_name("N")
        ->group(group);
    command
        .add_option("--threads", words.threads,
                    "Number of threads. Does not change the image. Default: one for each processor "
                    "that the process may use; quotas of containers count")
        ->check(whole_number(0, 4096))
        ->type_name("N")
        ->group(group);
}

void add_plannable_options(CLI::App& command, RenderWords& words)
{
    command.add_option("file", words.file, "The scene: .gltf or .glb; - is the standard input")
        ->required()
        ->type_name("FILE");
    add_image_output(command, words);
    add_how(command, words);
    add_samples_option(command, words.part, "How to render");
    add_transport_options(command, words.transport);
    add_film_options(command, words.film);
    add_ground_options(command, words.ground, "Film");
    add_view_options(command, words);
}

void add_render_options(CLI::App& command, RenderWords& words)
{
    add_plannable_options(command, words);
    add_process_options(command, words);
    add_sequence_options(command, words.sequence);
    command.footer(render_examples);
}

RenderArguments understand(const RenderWords& words)
{
    RenderArguments result;
    result.file = words.file;
    result.outputs.assign(words.outputs.begin(), words.outputs.end());
    result.part = part_choice(words.part);
    result.sequence = sequence(words);
    result.goal = to_goal(words);
    result.samples = to_samples(words, result.goal);
    if (words.size) {
        result.size = parse_size(*words.size);
        if (!result.size) {
            reject("--size", *words.size, "WIDTHxHEIGHT from 1x1 to 65535x65535");
        }
    }
    result.options.sampling.sampler =
        words.sampler == "independent" ? SamplerKind::independent : SamplerKind::sobol;
    result.options.system.threads = words.threads;
    result.isa = to_isa(words.isa);
    result.options.sampling.seed = to_seed(words.seed);
    result.rates = rates_choice(words.rates);
    result.options = with_transport(words.transport, result.options);
    result.options = with_film(words.film, result.options);
    if (!result.options.film.aovs.empty() && !writes_exr(result.outputs) && !result.part) {
        reject("--aov", *words.film.aovs,
               "an .exr file among the outputs, or --part, to hold the layers");
    }
    result.camera = words.camera;
    result.view = to_view(words);
    check_lens(words.lens);
    result.lens = words.lens;
    result.scene = to_gltf_options(words.scene);
    result.memory = memory_limit(words.scene);
    result.environment = words.environment;
    result.texture_filter =
        words.texture_filter == "mip" ? TextureFilter::mip_mapped : TextureFilter::bilinear;
    result.environment_change = understand(words.environment_change);
    result.fog = understand(words.fog);
    result.volume = understand(words.volume);
    result.display = understand(words.display);
    if (result.display.backdrop) {
        result.options.transport.background = Background::none;
        result.options.film.aovs.insert(Aov::alpha);
    }
    result.options = with_ground(words.ground, result.options);
    check_beside_ground("--fog", words.fog.extinction, result.options);
    check_beside_ground("--volume", words.volume.file, result.options);
    result.denoise = understand(words.denoise);
    if (result.denoise) {
        result.options.film.aovs.insert(Aov::albedo);
        result.options.film.aovs.insert(Aov::normal);
    }
    result.channel_type =
        words.half ? io::ExrChannelType::half_float : io::ExrChannelType::single_float;
    result.storage = words.tiled ? io::ExrStorage::tiles : io::ExrStorage::scanlines;
    result.stats = words.stats;
    result.profiling = words.profile ? Profiling::on : Profiling::off;
    result.strategies = strategy_files(words.strategies, result.options, words.part);
    if (words.viewer) {
        result.viewer = parse_address(*words.viewer);
        if (!result.viewer) {
            reject("--display", *words.viewer, "HOST or HOST:PORT, like localhost:14158");
        }
    }
    result.format = words.json ? Format::json : Format::text;
    result.verbosity = words.quiet ? Verbosity::quiet : Verbosity::normal;
    std::vector<std::filesystem::path> written = result.outputs;
    written.push_back(result.stats.value_or(""));
    check_pipes(std::array{result.file, std::filesystem::path(result.environment.value_or(""))},
                written, result.format);
    return result;
}

}  // namespace bdpt::app
