#include "report/compare_text.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "terminal/text.h"

namespace bdpt::app {
namespace {

using eval::ComparisonReport;

constexpr std::array<const char*, 4> channel_names{"red", "green", "blue", "mean"};

std::string optional_text(const std::optional<double>& value)
{
    return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string metrics_text(const ComparisonReport& report)
{
    const bool seeds = report.images.size() > 1;
    std::string result = seeds ? fmt::format("{:<10}{:>12}{:>12}{:>12}{:>12}\n", "metric", "mean",
                                             "deviation", "least", "greatest")
                               : fmt::format("{:<10}{:>12}\n", "metric", "value");
    for (const eval::MetricSummary& metric : report.metrics) {
        const std::string_view name = to_string(metric.metric);
        result += fmt::format("{:<10}{:>12.6g}", name, metric.mean);
        if (seeds) {
            result += fmt::format("{:>12}{:>12.6g}{:>12.6g}", optional_text(metric.deviation),
                                  metric.least, metric.greatest);
        }
        result += metric.metric == eval::Metric::psnr
                      ? fmt::format("  dB, peak {:.4g}\n", report.scale.peak)
                      : "\n";
    }
    return result;
}

std::string bias_text(const ComparisonReport& report)
{
    const eval::Bias& bias = report.bias;
    std::string result = fmt::format("{:<10}{:>12}{:>18}\n", "bias", "value", "standard error");
    for (std::size_t c = 0; c < channel_names.size(); ++c) {
        result += fmt::format("{:<10}{:>12.4g}{:>18}\n", channel_names[c], bias.channels[c].value,
                              optional_text(bias.channels[c].standard_error));
    }
    if (bias.source == eval::BiasSource::blocks) {
        return result + "(from blocks of one image; a folder of seeds tells more)\n";
    }
    return result + fmt::format("standard error of a pixel {}, of a tile {}\n",
                                optional_text(bias.pixel_standard_error),
                                optional_text(bias.tile_standard_error));
}

std::string tiles_text(const ComparisonReport& report)
{
    std::string result = fmt::format("worst tiles of {0} x {0} by {1}\n", report.tile_size,
                                     to_string(report.map_metric));
    for (const eval::TileError& tile : report.worst_tiles) {
        result += fmt::format("  {:<24}{:>12.4g}\n", rect_text(tile.tile), tile.value);
    }
    if (report.biased_tiles.empty()) {
        return result;
    }
    result += fmt::format("\n{:<26}{:<8}{:>12}{:>16}{:>8}{:>10}\n", "tiles by bias", "channel",
                          "bias", "standard error", "t", "p (Holm)");
    for (const eval::TileBias& tile : report.biased_tiles) {
        result +=
            fmt::format("  {:<24}{:<8}{:>12.4g}{:>16.4g}{:>8.3g}{:>10.3g}\n", rect_text(tile.tile),
                        channel_names[static_cast<std::size_t>(tile.channel)], tile.bias,
                        tile.standard_error, tile.t, tile.p);
    }
    return result;
}

}  // namespace

std::string compare_text(const ComparisonReport& report,
                         std::span<const eval::ThresholdResult> thresholds)
{
    const std::size_t count = report.images.size();
    std::string result = fmt::format("{} of {} x {} pixels\n\n{}\n{}\n{}",
                                     count == 1 ? "1 image" : fmt::format("{} images", count),
                                     report.region.width(), report.region.height(),
                                     metrics_text(report), bias_text(report), tiles_text(report));
    for (const eval::ThresholdResult& threshold : thresholds) {
        result +=
            fmt::format("{}threshold {}={:.6g}: {} with {:.6g}\n",
                        &threshold == thresholds.data() ? "\n" : "", threshold.name,
                        threshold.limit, threshold.passed ? "passed" : "failed", threshold.value);
    }
    return result;
}

}  // namespace bdpt::app
