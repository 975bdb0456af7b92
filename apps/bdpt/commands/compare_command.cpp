#include "commands/commands.h"

#include <bdpt/eval/comparison.h>
#include <bdpt/eval/drawing.h>
#include <bdpt/io/write_image.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string>
#include <system_error>
#include <vector>

#include "options/output_files.h"
#include "options/render_arguments.h"
#include "report/reports.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Arguments of `bdpt compare`.
struct CompareArguments {
    std::filesystem::path image{};  ///< an image, or a folder of images
    std::filesystem::path reference{};
    std::optional<std::string> layer{};
    std::optional<std::vector<eval::Metric>> metrics{};  ///< none: all
    eval::ComparisonOptions options{};
    std::vector<eval::Threshold> thresholds{};
    std::optional<std::filesystem::path> error_image{};
    double scale = 1.0;  ///< scale of the error image
    Printed printed{};
};

constexpr int threshold_exceeded = 10;  // exit code

std::optional<std::vector<eval::Metric>> parse_metrics(const std::string& text)
{
    return parse_each_once<eval::Metric>(text, eval::parse_metric);
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
std::optional<eval::Metric> parse_map_metric(const std::string& text)
{
    const std::optional<eval::Metric> metric = eval::parse_metric(text);
    return metric && *metric != eval::Metric::psnr ? metric : std::nullopt;
}

ValueType<double> positive()
{
    return number_above(0.0, std::numeric_limits<double>::max(), "a number above 0");
}

void add_measures(OptionList& options, CompareArguments& arguments)
{
    eval::MetricOptions& scale = arguments.options.scale;
    options.section("What to measure");
    options.add("--metrics", "LIST", "Metrics, comma-separated. Default: all", arguments.metrics,
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
                "eval::Metric of the error image and of the worst tiles. Default: relmse",
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

constexpr const char* compare_footer = R"(Examples:
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

void add_compare_options(OptionList& options, CompareArguments& arguments)
{
    options
        .add("image", "FILE|DIR",
             "The image to evaluate (.exr, .hdr, .png, .jpg or .webp), or a folder",
             arguments.image, any_text())
        .required = true;
    options.add("reference", "FILE", "The reference image", arguments.reference, any_text())
        .required = true;
    add_measures(options, arguments);
    add_output(options, arguments);
}

/// Adds the metrics of thresholds to those that are measured.
CompareArguments checked(const CompareArguments& arguments, const OptionList& /*options*/)
{
    CompareArguments result = arguments;
    std::vector<eval::Metric>& metrics = result.options.metrics;
    metrics = arguments.metrics.value_or(
        std::vector<eval::Metric>(eval::all_metrics.begin(), eval::all_metrics.end()));
    for (const eval::Threshold& threshold : result.thresholds) {
        if (threshold.kind == eval::ThresholdKind::metric && !is_among(metrics, threshold.metric)) {
            metrics.push_back(threshold.metric);
        }
    }
    return result;
}

/// Checks, before anything is read, that outputs can be written.
void check_error_image(const CompareArguments& arguments, std::span<const fs::path> files)
{
    if (!arguments.error_image) {
        return;
    }
    const std::vector<fs::path> outputs{*arguments.error_image};
    if (!has_extension(outputs.front(), ".png")) {
        throw Error(ErrorCode::usage,
                    fmt::format("--error-image \"{}\": expected a file name that ends in .png",
                                arguments.error_image->string()));
    }
    std::vector<fs::path> inputs(files.begin(), files.end());
    inputs.push_back(arguments.reference);
    check_outputs(outputs, inputs);
}

void write_error_image(const CompareArguments& arguments, const eval::ComparisonReport& report)
{
    io::PngOptions options;
    options.metadata.version = BDPT_VERSION;
    options.metadata.created = std::chrono::system_clock::now();
    io::write_png(
        *arguments.error_image,
        eval::false_color(report.map, {.scale = arguments.scale,
                                       .title = std::string(to_string(report.map_metric))}),
        options);
}

int run_compare(const CompareArguments& arguments)
{
    std::error_code missing;
    if (fs::is_directory(arguments.reference, missing)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: the reference is a folder; it must be one file, given second",
                                arguments.reference.string()));
    }
    const std::vector<fs::path> files = eval::seed_files(arguments.image, arguments.reference);
    check_error_image(arguments, files);
    const eval::FileComparison comparison =
        eval::compare_files(files, arguments.reference, arguments.layer, arguments.options);
    const eval::ComparisonReport& report = comparison.report;
    std::vector<eval::ThresholdResult> results;
    for (const eval::Threshold& threshold : arguments.thresholds) {
        results.push_back(eval::check_threshold(report, threshold));
    }
    const bool passed = std::all_of(results.begin(), results.end(),
                                    [](const auto& result) { return result.passed; });

    // stdout has the report alone, so warnings go to stderr in both formats.
    TerminalConsole console(Format::text, arguments.printed.verbosity);
    for (const std::string& warning : comparison.warnings) {
        console.warning(warning);
    }
    // Failure of the image; deferred, so that the report is still printed.
    std::exception_ptr failure;
    if (arguments.error_image) {
        try {
            write_error_image(arguments, report);
        } catch (const Error&) {
            failure = std::current_exception();
        }
    }
    if (arguments.printed.format == Format::json) {
        print_text(eval::comparison_json(report, results, arguments.image.string(),
                                         arguments.reference.string()));
    } else if (arguments.printed.verbosity == Verbosity::normal) {
        print_text(compare_text(report, results));
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
    return passed ? 0 : threshold_exceeded;
}

}  // namespace

void add_compare_command(Program& program)
{
    add_command<CompareArguments>(program, "compare",
                                  "Measure the error of images against a reference", compare_footer,
                                  add_compare_options, checked_by(run_compare));
}

}  // namespace bdpt::app
