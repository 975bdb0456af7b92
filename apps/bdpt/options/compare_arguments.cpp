#include "options/compare_arguments.h"

#include <bdpt/eval/metrics/metric.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

using eval::Metric;

constexpr const char* compare_examples = R"(Examples:
  bdpt compare out.exr reference.exr
  bdpt compare seeds/ reference.exr --error-image error.png
  bdpt compare out.exr reference.exr --threshold relmse=0.01 --metrics relmse,flip --json

The first image is compared with the second, the reference: relative errors divide by it. If the
first is a folder, each .exr and .hdr file in it is a render of the same scene with another seed,
and the tiles are tested for bias.

Metrics: relmse, relmse_scales (also of averages over squares of pixels, where blotches show), mse,
rmse, mape, smape, psnr, flip (of high dynamic range), flip_ldr (of the images as .png files show
them). docs/compare.md has their formulas.

Exit codes: 0 done, 10 a threshold was exceeded (all output has been written), 2 wrong usage, 3 input
not found, 4 invalid input (also: sizes that differ, NaN, infinity), 5 unsupported file, 6 output
cannot be written, 7 out of memory.)";

std::vector<Metric> to_metrics(const std::optional<std::string>& words)
{
    if (!words) {
        return {eval::all_metrics.begin(), eval::all_metrics.end()};
    }
    std::vector<Metric> result;
    std::size_t begin = 0;
    while (begin <= words->size()) {
        const std::size_t end = std::min(words->find(',', begin), words->size());
        const std::optional<Metric> metric =
            eval::parse_metric(std::string_view(*words).substr(begin, end - begin));
        if (!metric) {
            reject("--metrics", *words,
                   "relmse, relmse_scales, mse, rmse, mape, smape, psnr, flip or flip_ldr, with "
                   "commas between");
        }
        if (std::find(result.begin(), result.end(), *metric) == result.end()) {
            result.push_back(*metric);
        }
        begin = end + 1;
    }
    return result;
}

/// "START,STOP,COUNT".
eval::FlipExposures to_exposures(const std::string& word)
{
    const std::optional<Vec3> numbers = parse_vec3(word);
    constexpr float most = 100.0f;  // [EV] or of them: far beyond what scenes need
    if (!numbers || std::abs(numbers->x) > most || std::abs(numbers->y) > most ||
        numbers->x >= numbers->y || numbers->z < 2.0f || numbers->z > most ||
        std::floor(numbers->z) != numbers->z) {
        reject("--flip-exposures", word,
               "START,STOP,COUNT: EV from -100 to 100 that rise, and 2 to 100 of them");
    }
    return {.start = static_cast<double>(numbers->x),
            .stop = static_cast<double>(numbers->y),
            .count = static_cast<int>(numbers->z)};
}

double positive(const char* option, double value)
{
    if (!(std::isfinite(value) && value > 0.0)) {
        reject(option, fmt::format("{}", value), "a number greater than 0");
    }
    return value;
}

eval::MetricOptions to_scale(const CompareWords& words)
{
    eval::MetricOptions scale;
    scale.epsilon = positive("--epsilon", words.epsilon);
    scale.epsilon_unit =
        words.relative ? eval::EpsilonUnit::reference_mean : eval::EpsilonUnit::absolute;
    if (words.peak) {
        scale.peak = positive("--peak", *words.peak);
    }
    if (words.pixels_per_degree) {
        if (!(*words.pixels_per_degree >= 1.0 && *words.pixels_per_degree <= 1000.0)) {
            reject("--ppd", fmt::format("{}", *words.pixels_per_degree),
                   "pixels per degree from 1 to 1000");
        }
        scale.pixels_per_degree = *words.pixels_per_degree;
    }
    if (words.exposures) {
        scale.exposures = to_exposures(*words.exposures);
    }
    if (words.exposure) {
        if (!(std::abs(*words.exposure) <= 100.0)) {
            reject("--exposure", fmt::format("{}", *words.exposure), "EV from -100 to 100");
        }
        scale.exposure = static_cast<float>(*words.exposure);
    }
    return scale;
}

Metric to_map_metric(const std::string& word)
{
    const std::optional<Metric> metric = eval::parse_metric(word);
    if (!metric || *metric == Metric::psnr) {
        reject("--error-metric", word,
               "relmse, relmse_scales, mse, rmse, mape, smape, flip or flip_ldr");
    }
    return *metric;
}

std::vector<eval::Threshold> to_thresholds(const std::vector<std::string>& words)
{
    std::vector<eval::Threshold> result;
    for (const std::string& word : words) {
        const std::optional<eval::Threshold> threshold = eval::parse_threshold(word);
        if (!threshold) {
            reject("--threshold", word, "NAME=NUMBER, where NAME is a metric, bias or p");
        }
        result.push_back(*threshold);
    }
    return result;
}

void add_measures(CLI::App& command, CompareWords& words)
{
    const auto group = "What to measure";
    command.add_option("--metrics", words.metrics, "Metrics, comma-separated. Default: all")
        ->type_name("LIST")
        ->group(group);
    command
        .add_option("--layer", words.layer,
                    "Layer of the .exr files, like albedo or depth. Default: the image itself")
        ->type_name("NAME")
        ->group(group);
    command
        .add_option("--epsilon", words.epsilon,
                    "Added to the divisor of relative errors: to r^2 in relmse, to |r| in mape, to "
                    "|x| + |r| in smape. Default: 0.01")
        ->type_name("E")
        ->group(group);
    command
        .add_flag("--relative", words.relative,
                  "Multiply epsilon by the reference's mean (for relmse: by its square). Then "
                  "relmse, mape and smape do not depend on the unit of light")
        ->group(group);
    command
        .add_option("--peak", words.peak,
                    "Peak of psnr. Default: the reference's greatest component")
        ->type_name("PEAK")
        ->group(group);
    command
        .add_option("--ppd", words.pixels_per_degree,
                    "Pixels per degree of flip. Default: 67, a 4K screen 0.7 m wide at 0.7 m")
        ->type_name("N")
        ->group(group);
    command
        .add_option("--flip-exposures", words.exposures,
                    "Range of exposures of flip [EV] and their number. Default: from the reference")
        ->type_name("START,STOP,COUNT")
        ->group(group);
    command
        .add_option("--exposure", words.exposure,
                    "Exposure of flip_ldr, as of bdpt render. Default: from the reference")
        ->type_name("EV")
        ->group(group);
}

void add_output(CLI::App& command, CompareWords& words)
{
    const auto group = "Output";
    command
        .add_option("--threshold", words.thresholds,
                    "Exit with code 10 if the metric (or bias, the greatest of any channel) is "
                    "greater, or psnr (or p, the lowest of any tile) is less. May be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=NUMBER")
        ->group(group);
    command
        .add_option("--error-image", words.error_image,
                    "Write the error of each pixel to this .png file, in false colours")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--error-metric", words.error_metric,
                    "Metric of the error image and of the worst tiles. Default: relmse")
        ->type_name("METRIC")
        ->group(group);
    command
        .add_option("--scale", words.scale,
                    "Error of the last colour. Default: 1, so that error images are comparable")
        ->type_name("MAX")
        ->group(group);
    command.add_option("--tile", words.tile_size, "Side of a tile [pixels]. Default: 32")
        ->check(whole_number(1, 65535))
        ->type_name("N")
        ->group(group);
    command.add_option("--worst", words.worst_tiles, "Number of worst tiles to print. Default: 5")
        ->check(whole_number(1, 1000000))
        ->type_name("N")
        ->group(group);
    command.add_flag("--json", words.json, "Print one JSON object instead of text")->group(group);
    command.add_flag("-q,--quiet", words.quiet, "Print only errors and the object of --json")
        ->group(group);
}

}  // namespace

void add_compare_options(CLI::App& command, CompareWords& words)
{
    command.add_option("image", words.image, "The image to evaluate, .exr or .hdr, or a folder")
        ->required()
        ->type_name("FILE|DIR");
    command.add_option("reference", words.reference, "The reference image")
        ->required()
        ->type_name("FILE");
    add_measures(command, words);
    add_output(command, words);
    command.footer(compare_examples);
}

CompareArguments understand(const CompareWords& words)
{
    CompareArguments result;
    result.image = words.image;
    result.reference = words.reference;
    result.layer = words.layer;
    result.options.metrics = to_metrics(words.metrics);
    result.options.scale = to_scale(words);
    result.options.map_metric = to_map_metric(words.error_metric);
    result.options.tile_size = words.tile_size;
    result.options.worst_tiles = words.worst_tiles;
    result.thresholds = to_thresholds(words.thresholds);
    for (const eval::Threshold& threshold : result.thresholds) {
        std::vector<Metric>& metrics = result.options.metrics;
        if (threshold.kind == eval::ThresholdKind::metric &&
            std::find(metrics.begin(), metrics.end(), threshold.metric) == metrics.end()) {
            metrics.push_back(threshold.metric);
        }
    }
    if (words.error_image) {
        result.error_image = *words.error_image;
    }
    result.scale = positive("--scale", words.scale);
    result.format = words.json ? Format::json : Format::text;
    result.verbosity = words.quiet ? Verbosity::quiet : Verbosity::normal;
    return result;
}

}  // namespace bdpt::app
