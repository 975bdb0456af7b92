#pragma once

/// @file
/// Decides whether images are good enough.
///
/// @code{.cpp}
/// bool is_good_enough(const bdpt::eval::ComparisonReport& report)
/// {
///     const auto threshold = bdpt::eval::parse_threshold("relmse=0.01");
///     return threshold && bdpt::eval::check_threshold(report, *threshold).passed;
/// }
/// @endcode

#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/eval/metrics/metric.h>
#include <bdpt/export.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::eval {

/// Quantity that a threshold limits.
enum class ThresholdKind : std::uint8_t {
    metric,  ///< mean of the metric over the images
    bias,    ///< greatest absolute bias of the three channels
    p,       ///< lowest p of all tiles
};

/// The worst value that passes.
struct Threshold {
    ThresholdKind kind = ThresholdKind::metric;
    Metric metric = Metric::relmse;  ///< if `kind` is metric
    double limit = 0.0;              ///< minimum of psnr or p, maximum of other quantities
};

/// Parses "NAME=VALUE", where NAME is a metric, "bias" or "p". Returns none for anything else.
[[nodiscard]] BDPT_EXPORT std::optional<Threshold> parse_threshold(std::string_view text);

/// Result of a threshold.
struct ThresholdResult {
    std::string name;
    double limit = 0.0;
    double value = 0.0;
    bool passed = false;
};

/// Checks a report against a threshold. Throws `Error` (usage) if the report does not have the
/// metric, or has a single image and so no p.
[[nodiscard]] BDPT_EXPORT ThresholdResult check_threshold(const ComparisonReport& report,
                                                          const Threshold& threshold);

}  // namespace bdpt::eval
