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
#include "report/eval_text.h"

namespace bdpt::app {

namespace {

namespace fs = std::filesystem;

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

}  // namespace

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
    return passed ? 0 : compare_failed;
}

}  // namespace bdpt::app
