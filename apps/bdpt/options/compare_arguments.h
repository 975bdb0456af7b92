#pragma once

#include <bdpt/eval/compare/comparison.h>
#include <bdpt/eval/compare/threshold.h>
#include <bdpt/eval/metrics/metric.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/option_list.h"
#include "options/part_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt compare`.
struct CompareArguments {
    std::filesystem::path image{};  ///< an image, or a folder of images
    std::filesystem::path reference{};
    std::optional<std::string> layer{};
    eval::ComparisonOptions options{};
    std::vector<eval::Threshold> thresholds{};
    std::optional<std::filesystem::path> error_image{};
    double scale = 1.0;  ///< scale of the error image
    Printed printed{};
};

/// Options of `bdpt compare`, as given.
struct CompareRequest {
    CompareArguments arguments{};
    std::optional<std::vector<eval::Metric>> metrics{};  ///< none: all
};

extern const char* const compare_footer;

/// Adds the options of `bdpt compare`.
void add_compare_options(OptionList& options, CompareRequest& request);

/// Checks and converts the options; adds the metrics of thresholds to those that are measured.
[[nodiscard]] CompareArguments checked(const CompareRequest& request, const OptionList& options);

}  // namespace bdpt::app
