#pragma once

/// @file
/// Compares files of images with a reference.
///
/// @code{.cpp}
/// const std::vector<std::filesystem::path> files = {"seed0.exr", "seed1.exr"};
/// const auto [report, warnings] = bdpt::eval::compare_files(files, "reference.exr", {}, {});
/// for (const bdpt::eval::MetricSummary& metric : report.metrics) {
///     std::cout << bdpt::eval::to_string(metric.metric) << ": " << metric.mean << '\n';
/// }
/// @endcode

#include <bdpt/eval/compare/comparison.h>
#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/export.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt::eval {

/// The result of `compare_files`.
struct FileComparison {
    ComparisonReport report;
    std::vector<std::string> warnings;  ///< one line each, with the file's name
};

/// Reads the images one at a time and compares them with the reference, within the region for which
/// both the reference and the first image have data; the other images must have data for all of it.
/// `layer` is that of `io::ImageOptions`; x0 and y0 of the options are set from the files.
///
/// Throws `Error`, whose message names the file: those of `io::read_image` and `Comparison`, and
/// invalid_input for images of different size or without pixels in common.
[[nodiscard]] BDPT_EXPORT FileComparison compare_files(std::span<const std::filesystem::path> files,
                                                       const std::filesystem::path& reference,
                                                       const std::optional<std::string>& layer,
                                                       const ComparisonOptions& options);

}  // namespace bdpt::eval
