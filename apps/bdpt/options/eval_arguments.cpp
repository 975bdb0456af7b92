#include "options/eval_arguments.h"

#include <bdpt/options/enumerators.h>
#include <bdpt/options/option_fields.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>

#include "options/arguments.h"
#include "options/groups/film_arguments.h"
#include "options/value_types.h"

namespace bdpt::app {

namespace {

using eval::Metric;

/// Parses values separated by commas; each once.
template <typename Value>
std::optional<std::vector<Value>> parse_each_once(
    const std::string& text, std::optional<Value> (*parse)(std::string_view part))
{
    std::vector<Value> result;
    for (const std::string_view part : split(text, ',')) {
        const std::optional<Value> value = parse(part);
        if (!value) {
            return std::nullopt;
        }
        if (std::find(result.begin(), result.end(), *value) == result.end()) {
            result.push_back(*value);
        }
    }
    return result;
}

std::optional<std::vector<Metric>> parse_metrics(const std::string& text)
{
    return parse_each_once<Metric>(text, eval::parse_metric);
}

/// Parses "START,STOP,COUNT".
std::optional<eval::FlipExposures> parse_exposures(const std::string& text)
{
    const std::optional<Vec3> numbers = parse_vec3(text);
    constexpr float most = 100.0f;  // [EV], and maximum count; far beyond what scenes need
    if (!numbers || std::abs(numbers->x) > most || std::abs(numbers->y) > most ||
        numbers->x >= numbers->y || numbers->z < 2.0f || numbers->z > most ||
        std::floor(numbers->z) != numbers->z) {
        return std::nullopt;
    }
    return eval::FlipExposures{.start = static_cast<double>(numbers->x),
                               .stop = static_cast<double>(numbers->y),
                               .count = static_cast<int>(numbers->z)};
}

/// Parses a metric that has maps.
std::optional<Metric> parse_map_metric(const std::string& text)
{
    const std::optional<Metric> metric = eval::parse_metric(text);
    return metric && *metric != Metric::psnr ? metric : std::nullopt;
}

ValueType<double> positive()
{
    return number_above(0.0, std::numeric_limits<double>::max(), "a number above 0");
}

void add_measures(OptionList& options, CompareRequest& request)
{
    CompareArguments& arguments = request.arguments;
    eval::MetricOptions& scale = arguments.options.scale;
    options.section("What to measure");
    options.add("--metrics", "LIST", "Metrics, comma-separated. Default: all", request.metrics,
                parsed_by(parse_metrics,
                          "a comma-separated list of relmse, relmse_scales, mse, rmse, mape, "
                          "smape, psnr, flip and flip_ldr"));
    options.add("--layer", "NAME",
                "Layer of the .exr files, like albedo or depth. Default: the image itself",
                arguments.layer, any_text());
    options.add("--epsilon", "E",
                "Added to the divisor of relative errors: to r^2 in relmse, to |r| in mape, to |x| "
                "+ |r| in smape. Default: 0.01",
                scale.epsilon, positive());
    options.add_flag("--relative",
                     "Multiply epsilon by the reference's mean (for relmse: by its square). Then "
                     "relmse, mape and smape do not depend on the unit of light",
                     scale.epsilon_unit,
                     on_or_off(eval::EpsilonUnit::reference_mean, eval::EpsilonUnit::absolute));
    options.add("--peak", "PEAK", "Peak value of psnr. Default: the reference's maximum",
                scale.peak, positive());
    options.add("--ppd", "N",
                "Pixels per degree of flip. Default: 67, a 4K screen 0.7 m wide at 0.7 m",
                scale.pixels_per_degree, number(1.0, 1000.0, "pixels per degree from 1 to 1000"));
    options.add("--flip-exposures", "START,STOP,COUNT",
                "Range of exposures of flip [EV] and their number. Default: from the reference",
                scale.exposures,
                parsed_by(parse_exposures,
                          "START,STOP,COUNT: START below STOP, EV from -100 to 100, and a COUNT "
                          "from 2 to 100"));
    options.add("--exposure", "EV",
                "Exposure of flip_ldr, as of bdpt render. Default: from the reference",
                scale.exposure, number(-100.0, 100.0, "EV from -100 to 100"));
}

void add_output(OptionList& options, CompareArguments& arguments)
{
    options.section("Output");
    options.add_repeated(
        "--threshold", "NAME=NUMBER",
        "Exit with code 10 if the metric (or bias, the largest of any channel) is above, or psnr "
        "(or p, the lowest of any tile) below this. May be repeated",
        arguments.thresholds,
        parsed_by(eval::parse_threshold, "NAME=NUMBER, where NAME is a metric, bias or p"));
    options.add("--error-image", "FILE",
                "Write the error of each pixel to this .png file, in false colours",
                arguments.error_image, any_text());
    options.add("--error-metric", "METRIC",
                "Metric of the error image and of the worst tiles. Default: relmse",
                arguments.options.map_metric,
                parsed_by(parse_map_metric,
                          "relmse, relmse_scales, mse, rmse, mape, smape, flip or flip_ldr"));
    options.add("--scale", "MAX",
                "Error shown as the last colour. Default: 1, so that error images are comparable",
                arguments.scale, positive());
    options.add("--tile", "N", "Side of a tile [pixels]. Default: 32", arguments.options.tile_size,
                whole_number(1, 65535));
    options.add("--worst", "N", "Number of worst tiles to print. Default: 5",
                arguments.options.worst_tiles, whole_number(1, 1000000));
    add_json_option(options, arguments.printed, "Print one JSON object instead of text");
    add_quiet_option(options, arguments.printed, "Print only errors and the object of --json");
}

}  // namespace

const char* const compare_footer = R"(Examples:
  bdpt compare out.exr reference.exr
  bdpt compare seeds/ reference.exr --error-image error.png
  bdpt compare out.exr reference.exr --threshold relmse=0.01 --metrics relmse,flip --json

The first image is compared with the second, the reference: relative errors divide by it. If the
first is a folder, each .exr and .hdr file in it is a render of the same scene with another seed,
and the tiles are tested for bias.

Metrics: relmse, relmse_scales (also of averages over pixel blocks, which shows blotches), mse,
rmse, mape, smape, psnr, flip (HDR-FLIP), flip_ldr (LDR-FLIP of the images as in .png files).
docs/compare.md has their formulas.

Exit codes: 0 done, 10 a threshold was exceeded (all output has been written), 2 wrong usage, 3 input
not found, 4 invalid input (also: sizes that differ, NaN, infinity), 5 unsupported file, 6 output
cannot be written, 7 out of memory.)";

void add_compare_options(OptionList& options, CompareRequest& request)
{
    CompareArguments& arguments = request.arguments;
    options
        .add("image", "FILE|DIR",
             "The image to evaluate (.exr, .hdr, .png, .jpg or .webp), or a folder",
             arguments.image, any_text())
        .required = true;
    options.add("reference", "FILE", "The reference image", arguments.reference, any_text())
        .required = true;
    add_measures(options, request);
    add_output(options, arguments);
}

CompareArguments checked(const CompareRequest& request, const OptionList& /*options*/)
{
    CompareArguments result = request.arguments;
    std::vector<Metric>& metrics = result.options.metrics;
    metrics = request.metrics.value_or(
        std::vector<Metric>(eval::all_metrics.begin(), eval::all_metrics.end()));
    for (const eval::Threshold& threshold : result.thresholds) {
        if (threshold.kind == eval::ThresholdKind::metric &&
            std::find(metrics.begin(), metrics.end(), threshold.metric) == metrics.end()) {
            metrics.push_back(threshold.metric);
        }
    }
    return result;
}

namespace {

using eval::BenchOptions;

/// Benchmark settings with and without `--quick`.
struct Effort {
    double seconds;
    int pixels;
};
constexpr Effort quick_effort{.seconds = 0.5, .pixels = 9216};
constexpr Effort normal_effort{.seconds = 5.0, .pixels = 36864};

/// Time of each of the two renders of a reference relative to a run: its noise is then a small part
/// of the error of most runs.
constexpr double reference_effort = 12.0;

std::optional<std::vector<IntegratorKind>> parse_integrators(const std::string& text)
{
    return parse_each_once<IntegratorKind>(text, [](std::string_view part) {
        return parse_enumerator<IntegratorKind>(lower_case(part));
    });
}

/// Returns the stem of the file with characters that all file systems allow, distinct from `taken`.
std::string scene_name(const std::filesystem::path& file, std::set<std::string>& taken)
{
    std::string stem = file.stem().string();
    std::replace_if(
        stem.begin(), stem.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '-');
    stem = stem.empty() ? "scene" : stem;
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number) {
        name = fmt::format("{}-{}", stem, number);
    }
    return name;
}

void add_effort(OptionList& options, BenchRequest& request)
{
    BenchOptions& bench = request.arguments.options;
    const ValueType<double> time = duration("a time like 5s or 2m");
    options.section("Effort");
    options.add("--time", "TIME", "CPU time of each run at equal time, like 5s. Default: 5s",
                request.render.seconds, time);
    options.add("--spp", "N",
                "Samples per pixel of each run at equal samples. Default: the largest power of two "
                "for which every integrator stays within --time",
                bench.samples, whole_number(1, std::int64_t{1} << 20));
    options.add("--seeds", "N", "Runs of each integrator. Default: 5", bench.seeds,
                whole_number(1, 10000));
    options.add("--integrators", "LIST",
                "Integrators, comma-separated. Default: pt,nee,mis,lt,bdpt", bench.integrators,
                parsed_by(parse_integrators,
                          "a comma-separated list of pt, nee, mis, lt, bdpt, vcm and auto"));
    options.add("--reference-time", "TIME",
                "CPU time of each of the two renders of the reference. Default: 12 times --time",
                request.reference_seconds, time);
    options.add("--reference", "FILE|DIR",
                "Reference image to use instead of rendering one, or a folder with SCENE.exr",
                bench.reference, any_text());
    options.add("--strategy-depth", "N",
                "Maximum path length, in edges, in the pyramid of strategies; 0: none. Default: 5",
                bench.strategy_depth, whole_number(0, 32));
    options.add_flag("--quick",
                     "Small images and 0.5s per run, for a quick look or CI; --size and --time "
                     "override it",
                     request.quick);
}

}  // namespace

const char* const bench_footer = R"(Examples:
  bdpt bench scenes/cornell-box.gltf scenes/cornell-box-hidden.gltf -o out/bench
  bdpt bench scenes/*.gltf -o out/quick --quick
  bdpt bench room.glb -o out/room --integrators pt,mis,bdpt --time 20s --seeds 9 --env sky.hdr

The output folder gets report.html (for any browser), bench.json, bench.csv, the runs with their
images, and the references. Ctrl-C stops after the current pass; the same command resumes. Times are
CPU time of all threads. docs/bench.md explains the figures.

Exit codes: 0 done, 2 wrong usage (also: the folder holds runs with other options), 3 input not found,
4 invalid input (also: a broken file in the folder), 5 unsupported feature, 6 output cannot be
written (finished runs are kept), 7 out of memory or threads, 129 stopped by SIGHUP,
130 by SIGINT, 143 by SIGTERM.)";

void add_bench_options(OptionList& options, BenchRequest& request)
{
    options.add_repeated("files", "FILE", "The scenes: .gltf or .glb", request.files, any_text())
        .required = true;
    options.section("Output");
    options.add("-o,--output", "DIR", "Output folder", request.arguments.folder, any_text())
        .required = true;
    add_quiet_option(options, request.arguments.printed);
    add_json_option(options, request.arguments.printed,
                    "Print one JSON object per line on stdout: progress, scene, done. With --quiet "
                    "only done and error");
    add_effort(options, request);
    options.section("How to render");
    add_size_option(options, request.render,
                    "Image size. Default: about 37 000 pixels (9 216 with --quick) with the "
                    "camera's aspect ratio");
    add_fields(options, request.render.arguments.options,
               std::array<std::string_view, 3>{"max_depth", "sampler", "threads"});
    add_view_options(options, request.render);
}

BenchArguments checked(const BenchRequest& request, const OptionList& options)
{
    BenchArguments result = request.arguments;
    const Effort effort = request.quick ? quick_effort : normal_effort;
    result.pixels = effort.pixels;
    BenchOptions& bench = result.options;
    bench.seconds = request.render.seconds.value_or(effort.seconds);
    bench.reference_seconds = request.reference_seconds.value_or(reference_effort * bench.seconds);
    RenderRequest render = request.render;
    render.seconds.reset();  // time of a run, which is CPU time
    std::set<std::string> names;
    for (const std::string& file : request.files) {
        render.arguments.file = file;
        result.subjects.push_back(
            {.name = scene_name(file, names), .render = checked(render, options)});
    }
    bench.render = result.subjects.front().render.options;
    result.size = result.subjects.front().render.size;
    std::error_code missing;
    if (bench.reference && result.subjects.size() > 1 &&
        !std::filesystem::is_directory(*bench.reference, missing)) {
        options.reject_value("--reference",
                             "a folder with SCENE.exr for each scene, as there are several scenes");
    }
    return result;
}

Size bench_size(const Size& whole, int pixels)
{
    const double aspect = static_cast<double>(whole.width) / whole.height;
    const auto side = [](double length) {
        return static_cast<int>(std::clamp(std::round(length), 1.0, 65535.0));
    };
    return {side(std::sqrt(pixels * aspect)), side(std::sqrt(pixels / aspect))};
}

namespace {

void add_how(OptionList& options, VerifyRequest& request)
{
    RenderRequest& render = request.render;
    RenderOptions& render_options = render.arguments.options;
    options.section("How to verify");
    add_time_option(options, render,
                    "Maximum render time, like 90s, 2m or 1.5h; verify stops earlier if possible. "
                    "Default: 2m");
    add_size_option(options, render, "Image size. Default: 32x32");
    options.add("--max-depth", "N", "Maximum path length tested, in edges. Default: 5",
                request.options.max_depth, whole_number(1, 64));
    options.add("--grid", "N", "Tiles along each side of the image. Default: 4",
                request.options.grid, whole_number(1, 64));
    options.add("--bias", "PERCENT",
                "Smallest error of a strategy that must be detected, as a change of the image mean "
                "[%]. Default: 1",
                request.options.detectable_bias, percent(100.0));
    options.add("--false-alarm", "PERCENT",
                "Probability that a correct renderer fails [%]. Default: 0.1",
                request.options.false_alarm, percent(50.0));
    const Choices<IntegratorKind> integrators{{{"bdpt", IntegratorKind::bdpt},
                                               {"auto", IntegratorKind::automatic},
                                               {"vcm", IntegratorKind::vcm}}};
    add_choice(options, "--integrator",
               "What is verified: bdpt (default); auto: bdpt with the light paths and connections "
               "that auto chooses; or vcm: bdpt and the image of vcm, which is correct if "
               "--merge-radius is small enough",
               render_options.integrator, integrators);
    add_fields(options, render_options,
               std::array<std::string_view, 7>{"seed", "threads", "light_paths", "connections",
                                               "connection_rays", "merge_radius", "light_samples"});
}

}  // namespace

const char* const verify_footer = R"(Examples:
  bdpt verify scene.gltf
  bdpt verify room.glb --from 0,1.6,2 --look-at 0,1,0 --time 10m
  bdpt verify scene.gltf --size 64x64 --max-depth 8 --json
  bdpt verify scene.gltf --light-paths 0.25 --connections 2
  bdpt verify scene.gltf --light-samples 4
  bdpt verify scene.gltf --integrator vcm --merge-radius 0.01

Renders the scene with pt, nee, mis, lt, bdpt and every strategy of bdpt, at low resolution and with
many independent samples, and tests whether they agree: for each path length, in the whole image and
in tiles. docs/verify.md explains the method and the numbers.

Exit codes: 0 pass, 10 fail: something disagrees, 11 inconclusive: nothing disagrees, but the noise
could hide it (use more --time); 1 internal error, 2 wrong usage, 3 input not found, 4 invalid
input, 5 unsupported feature, 6 output cannot be written, 7 out of memory or threads, 129 stopped by
SIGHUP, 130 by SIGINT, 143 by SIGTERM.)";

void add_verify_options(OptionList& options, VerifyRequest& request)
{
    RenderArguments& render = request.render.arguments;
    render.options.integrator = IntegratorKind::bdpt;
    render.options.bidirectional.merge_radius = eval::VerifyOptions::small_merge_radius;
    add_scene_file(options, request.render);
    add_how(options, request);
    add_view_options(options, request.render);
    options.section("Output");
    add_json_option(options, render.printed, "Print one JSON object on stdout instead of text");
    add_quiet_option(options, render.printed, "Print only errors and the object of --json");
}

VerifyArguments checked(const VerifyRequest& request, const OptionList& options)
{
    constexpr int widest = 4096;
    if (request.render.arguments.options.bidirectional.light_paths == 0.0) {
        throw OptionError("--light-paths must be above 0: without light paths there is only mis");
    }
    VerifyArguments result{.stage = checked(request.render, options), .options = request.options};
    eval::VerifyOptions& verify = result.options;
    if (const std::optional<Size>& size = result.stage.size) {
        if (std::max(size->width, size->height) > widest) {
            options.reject_value("--size", "WIDTHxHEIGHT from 1x1 to 4096x4096");
        }
        verify.width = size->width;
        verify.height = size->height;
    }
    result.stage.size = Size{.width = verify.width, .height = verify.height};
    verify.grid = std::min({verify.grid, verify.width, verify.height});
    if (request.render.seconds) {
        verify.seconds = result.stage.goal.seconds;
    }
    const RenderOptions& render = result.stage.options;
    verify.light_paths = render.bidirectional.light_paths;
    verify.connections = render.bidirectional.connections;
    verify.connection_rays = render.bidirectional.connection_rays;
    if (render.integrator == IntegratorKind::vcm) {
        verify.merge_radius = render.bidirectional.merge_radius;
    }
    verify.light_samples = render.sampling.light_samples;
    verify.seed = render.sampling.seed;
    verify.threads = render.system.threads;
    return result;
}

}  // namespace bdpt::app
