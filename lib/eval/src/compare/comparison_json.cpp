#include <bdpt/eval/comparison.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

#include "report/json_values.h"

namespace bdpt::eval {
namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 4> channel_names{"red", "green", "blue", "mean"};

ordered_json scale_json(const MetricScale& scale)
{
    return {{"epsilon", number_or_null(scale.epsilon)},
            {"squared_epsilon", number_or_null(scale.squared_epsilon)},
            {"peak", number_or_null(scale.peak)},
            {"pixels_per_degree", number_or_null(scale.pixels_per_degree)},
            {"flip_exposures",
             {{"start", number_or_null(scale.exposures.start)},
              {"stop", number_or_null(scale.exposures.stop)},
              {"count", scale.exposures.count}}},
            {"flip_ldr_exposure", number_or_null(static_cast<double>(scale.exposure))}};
}

ordered_json metrics_json(const ComparisonReport& report)
{
    ordered_json result = ordered_json::object();
    for (const MetricSummary& metric : report.metrics) {
        result[std::string(to_string(metric.metric))] = {
            {"mean", number_or_null(metric.mean)},
            {"standard_deviation", number_or_null(metric.deviation)},
            {"min", number_or_null(metric.least)},
            {"max", number_or_null(metric.greatest)}};
    }
    return result;
}

ordered_json bias_json(const Bias& bias)
{
    ordered_json result{{"from", bias.source == BiasSource::seeds ? "seeds" : "blocks"}};
    for (std::size_t c = 0; c < bias.channels.size(); ++c) {
        result[channel_names[c]] = {
            {"value", number_or_null(bias.channels[c].value)},
            {"standard_error", number_or_null(bias.channels[c].standard_error)}};
    }
    result["pixel_standard_error"] = number_or_null(bias.pixel_standard_error);
    result["tile_standard_error"] = number_or_null(bias.tile_standard_error);
    return result;
}

ordered_json tiles_json(const ComparisonReport& report)
{
    ordered_json worst = ordered_json::array();
    for (const TileError& tile : report.worst_tiles) {
        worst.push_back({{"rect", rect_json(tile.tile)}, {"value", number_or_null(tile.value)}});
    }
    ordered_json biased = ordered_json::array();
    for (const TileBias& tile : report.biased_tiles) {
        biased.push_back({{"rect", rect_json(tile.tile)},
                          {"channel", channel_names[static_cast<std::size_t>(tile.channel)]},
                          {"bias", number_or_null(tile.bias)},
                          {"standard_error", number_or_null(tile.standard_error)},
                          {"t", number_or_null(tile.t)},
                          {"p", number_or_null(tile.p)}});
    }
    return {{"size", report.tile_size},
            {"metric", std::string(to_string(report.map_metric))},
            {"worst", worst},
            {"biased", biased}};
}

ordered_json images_json(const ComparisonReport& report)
{
    ordered_json result = ordered_json::array();
    for (const ImageErrors& image : report.images) {
        ordered_json errors = ordered_json::object();
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            errors[std::string(to_string(report.metrics[i].metric))] =
                number_or_null(image.values[i]);
        }
        result.push_back({{"file", image.name}, {"metrics", errors}});
    }
    return result;
}

}  // namespace

std::string comparison_json(const ComparisonReport& report,
                            std::span<const ThresholdResult> thresholds, const std::string& image,
                            const std::string& reference)
{
    bool passed = true;
    ordered_json results = ordered_json::array();
    for (const ThresholdResult& threshold : thresholds) {
        passed = passed && threshold.passed;
        results.push_back({{"name", threshold.name},
                           {"limit", number_or_null(threshold.limit)},
                           {"value", number_or_null(threshold.value)},
                           {"passed", threshold.passed}});
    }
    const ordered_json result{{"image", image},
                              {"reference", reference},
                              {"seeds", report.images.size()},
                              {"region", rect_json(report.region)},
                              {"passed", passed},
                              {"metrics", metrics_json(report)},
                              {"bias", bias_json(report.bias)},
                              {"tiles", tiles_json(report)},
                              {"thresholds", results},
                              {"scale", scale_json(report.scale)},
                              {"images", images_json(report)}};
    return result.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bdpt::eval
