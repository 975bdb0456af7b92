#include "compare/tiles.h"
#include "metrics/check_images.h"

#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

namespace bdpt::eval {
namespace {

void check_options(const ComparisonOptions& options)
{
    if (options.map_metric == Metric::psnr) {
        throw Error(ErrorCode::usage, "psnr is not defined for single pixels");
    }
    if (options.tile_size < 1 || options.worst_tiles < 1) {
        throw Error(ErrorCode::usage, "tile size " + std::to_string(options.tile_size) + ", " +
                                          std::to_string(options.worst_tiles) +
                                          " worst tiles: at least 1 of both");
    }
}

/// Returns the reference if it is valid.
Image checked(const std::string& name, Image reference, const ComparisonOptions& options)
{
    check_options(options);
    check_image({.name = name, .image = reference, .x0 = options.x0, .y0 = options.y0});
    return reference;
}

}  // namespace

Comparison::Comparison(const std::string& name, Image reference, ComparisonOptions options)
    : reference_(checked(name, std::move(reference), options)),
      reference_name_(name),
      options_(std::move(options)),
      scale_(make_scale(reference_, options_.scale)),
      tiles_(make_tiles(reference_.width, reference_.height, options_.tile_size)),
      map_sum_(reference_.pixels.size()),
      bias_(reference_.width, reference_.height, tiles_)
{}

void Comparison::add(const std::string& name, const Image& image)
{
    check_image({.name = name, .image = image, .x0 = options_.x0, .y0 = options_.y0},
                {.name = "the reference " + reference_name_, .image = reference_});
    const ErrorMap map = error_terms(options_.map_metric, image, reference_, scale_);
    ImageErrors errors{.name = name, .values = {}};
    for (const Metric metric : options_.metrics) {
        const double terms = metric == options_.map_metric
                                 ? mean(map)
                                 : mean(error_terms(metric, image, reference_, scale_));
        errors.values.push_back(from_mean(metric, terms, scale_));
    }
    images_.push_back(std::move(errors));
    for (std::size_t i = 0; i < map_sum_.size(); ++i) {
        map_sum_[i] += map.values[i];
    }
    bias_.add(image, reference_);
}

std::vector<TileError> Comparison::worst_tiles(const ErrorMap& terms) const
{
    std::vector<TileError> result;
    for (const PixelRect& tile : tiles_) {
        result.push_back(
            {.tile = placed(tile), .value = tile_mean(terms.values, terms.width, tile)});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const TileError& a, const TileError& b) { return a.value > b.value; });
    result.resize(std::min(result.size(), static_cast<std::size_t>(options_.worst_tiles)));
    for (TileError& error : result) {
        error.value = from_mean(options_.map_metric, error.value, scale_);
    }
    return result;
}

std::vector<TileBias> Comparison::biased_tiles() const
{
    std::vector<TileBias> result = bias_.tile_tests();
    result.resize(std::min(result.size(), static_cast<std::size_t>(options_.worst_tiles)));
    for (TileBias& test : result) {
        test.tile = placed(test.tile);
    }
    return result;
}

MetricSummary Comparison::summarize(std::size_t metric) const
{
    const double images = static_cast<double>(images_.size());
    std::vector<double> values;
    for (const ImageErrors& image : images_) {
        values.push_back(image.values[metric]);
    }
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    MetricSummary result{.metric = options_.metrics[metric],
                         .mean = std::accumulate(values.begin(), values.end(), 0.0) / images,
                         .deviation = std::nullopt,
                         .least = *least,
                         .greatest = *greatest};
    // The PSNR of an image without errors is infinite.
    if (values.size() > 1 && std::isfinite(result.mean)) {
        double squares = 0.0;
        for (const double value : values) {
            squares += (value - result.mean) * (value - result.mean);
        }
        result.deviation = std::sqrt(squares / (images - 1.0));
    }
    return result;
}

PixelRect Comparison::placed(const PixelRect& rect) const
{
    return {.x0 = rect.x0 + options_.x0,
            .y0 = rect.y0 + options_.y0,
            .x1 = rect.x1 + options_.x0,
            .y1 = rect.y1 + options_.y0};
}

ComparisonReport Comparison::report() const
{
    ErrorMap terms{reference_.width, reference_.height, map_sum_};
    for (double& value : terms.values) {
        value /= static_cast<double>(images_.size());
    }
    ComparisonReport result{
        .region = placed({.x0 = 0, .y0 = 0, .x1 = reference_.width, .y1 = reference_.height}),
        .scale = scale_,
        .images = images_,
        .metrics = {},
        .bias = bias_.bias(),
        .tile_size = options_.tile_size,
        .map_metric = options_.map_metric,
        .worst_tiles = worst_tiles(terms),
        .biased_tiles = biased_tiles(),
        .map = std::move(terms)};
    for (std::size_t metric = 0; metric < options_.metrics.size(); ++metric) {
        result.metrics.push_back(summarize(metric));
    }
    for (double& value : result.map.values) {
        value = from_mean(options_.map_metric, value, scale_);
    }
    return result;
}

}  // namespace bdpt::eval
