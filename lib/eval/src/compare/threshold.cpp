#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace bdpt::eval {
namespace {

double metric_value(const ComparisonReport& report, Metric metric)
{
    for (const MetricSummary& summary : report.metrics) {
        if (summary.metric == metric) {
            return summary.mean;
        }
    }
    throw Error(ErrorCode::usage,
                "threshold " + std::string(to_string(metric)) + ": is not among the metrics");
}

double min_p(const ComparisonReport& report)
{
    if (report.biased_tiles.empty()) {
        throw Error(ErrorCode::usage, "threshold p: needs images of at least two seeds");
    }
    return report.biased_tiles.front().p;
}

double max_bias(const Bias& bias)
{
    double greatest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        greatest = std::max(greatest, std::abs(bias.channels[c].value));
    }
    return greatest;
}

}  // namespace

std::optional<Threshold> parse_threshold(std::string_view text)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view name = text.substr(0, equals);
    const std::string_view number = text.substr(equals + 1);
    Threshold result;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), result.limit);
    if (error != std::errc{} || end != number.data() + number.size() ||
        !std::isfinite(result.limit)) {
        return std::nullopt;
    }
    if (name == "bias" || name == "p") {
        result.kind = name == "p" ? ThresholdKind::p : ThresholdKind::bias;
        return result;
    }
    const std::optional<Metric> metric = parse_metric(name);
    if (!metric) {
        return std::nullopt;
    }
    result.metric = *metric;
    return result;
}

ThresholdResult check_threshold(const ComparisonReport& report, const Threshold& threshold)
{
    ThresholdResult result;
    result.limit = threshold.limit;
    bool more_is_better = false;
    switch (threshold.kind) {
        case ThresholdKind::metric:
            result.name = to_string(threshold.metric);
            result.value = metric_value(report, threshold.metric);
            more_is_better = !grows_with_error(threshold.metric);
            break;
        case ThresholdKind::bias:
            result.name = "bias";
            result.value = max_bias(report.bias);
            break;
        case ThresholdKind::p:
            result.name = "p";
            result.value = min_p(report);
            more_is_better = true;
            break;
    }
    result.passed = more_is_better ? result.value >= result.limit : result.value <= result.limit;
    return result;
}

}  // namespace bdpt::eval
