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

/// The quantity of a threshold.
enum class ThresholdKind : std::uint8_t {
    metric,  ///< the metric's mean over the images
    bias,    ///< the greatest of the three channels' absolute bias
    p,       ///< the lowest p of all tiles
};

/// The worst value that is still good.
struct Threshold {
    ThresholdKind kind = ThresholdKind::metric;
    Metric metric = Metric::relmse;  ///< if `kind` is metric
    double limit = 0.0;  ///< the least good psnr or p, the greatest good value of others
};

/// Reads "NAME=VALUE"; the name is a metric's, "bias" or "p". None for anything else.
[[nodiscard]] BDPT_EXPORT std::optional<Threshold> parse_threshold(std::string_view text);

/// Whether a threshold holds.
struct ThresholdResult {
    std::string name;
    double limit = 0.0;
    double value = 0.0;
    bool passed = false;
};

/// Holds a report against a threshold. Throws `Error` (usage) when the report does not have the
/// metric, or has one image and so no p.
[[nodiscard]] BDPT_EXPORT ThresholdResult check_threshold(const ComparisonReport& report,
                                                          const Threshold& threshold);

}  // namespace bdpt::eval
