#include <bdpt/eval/comparison.h>

#include <bdpt/error.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/pixel_rect.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "metrics/metric_parts.h"

namespace bdpt::eval {
namespace {

/// Returns tiles of `size` x `size` pixels that cover the image, row by row; those at the right and
/// the lower border are cut.
std::vector<PixelRect> make_tiles(int width, int height, int size)
{
    // Larger tiles are equivalent, but sums could overflow.
    const int side = std::min(size, std::max(width, height));
    std::vector<PixelRect> tiles;
    for (int y = 0; y < height; y += side) {
        for (int x = 0; x < width; x += side) {
            tiles.push_back({.x0 = x,
                             .y0 = y,
                             .x1 = std::min(x + side, width),
                             .y1 = std::min(y + side, height)});
        }
    }
    return tiles;
}

/// Returns the mean over `tile` of per-pixel values, in rows of `width`.
double tile_mean(std::span<const double> values, int width, const PixelRect& tile)
{
    double sum = 0.0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            sum += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)];
        }
    }
    return sum / (static_cast<double>(tile.width()) * static_cast<double>(tile.height()));
}

constexpr int block_side = 8;  // [pixels], more than the width of any of our pixel filters

}  // namespace

BiasEstimator::BiasEstimator(int width, int height, std::vector<PixelRect> tiles)
    : width_(width), height_(height), tiles_(std::move(tiles))
{
    sums_.fill(
        std::vector<double>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)));
    tile_means_.fill(std::vector<Moments>(tiles_.size()));
}

void BiasEstimator::add(const Image& image, const Image& reference)
{
    std::vector<double> difference(image.pixels.size());
    double mean_sum = 0.0;
    for (std::size_t c = 0; c < sums_.size(); ++c) {
        const int channel = static_cast<int>(c);
        for (std::size_t i = 0; i < difference.size(); ++i) {
            difference[i] = static_cast<double>(image.pixels[i][channel]) -
                            static_cast<double>(reference.pixels[i][channel]);
            sums_[c][i] += difference[i];
            squares_ += difference[i] * difference[i];
        }
        const double mean = std::accumulate(difference.begin(), difference.end(), 0.0) /
                            static_cast<double>(difference.size());
        means_[c].add(mean);
        mean_sum += mean;
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            tile_means_[c][t].add(tile_mean(difference, width_, tiles_[t]));
        }
    }
    means_[3].add(mean_sum / 3.0);
}

Bias BiasEstimator::bias() const
{
    if (means_[0].count() == 1) {
        return bias_of_one();
    }
    Bias result;
    result.source = BiasSource::seeds;
    for (std::size_t c = 0; c < result.channels.size(); ++c) {
        result.channels[c] = {.value = means_[c].mean(),
                              .standard_error = means_[c].standard_error()};
    }
    result.pixel_standard_error = pixel_standard_error();
    result.tile_standard_error = tile_standard_error();
    return result;
}

Bias BiasEstimator::bias_of_one() const
{
    Bias result;
    std::vector<double> average(sums_[0].size());
    const auto estimate = [this](const Moments& mean, const std::vector<double>& differences) {
        return Estimate{
            .value = mean.mean(),
            .standard_error = block_standard_error(differences, width_, height_, block_side)};
    };
    for (std::size_t c = 0; c < sums_.size(); ++c) {
        result.channels[c] = estimate(means_[c], sums_[c]);
        for (std::size_t i = 0; i < average.size(); ++i) {
            average[i] += sums_[c][i] / 3.0;
        }
    }
    result.channels[3] = estimate(means_[3], average);
    return result;
}

double BiasEstimator::pixel_standard_error() const
{
    const double images = static_cast<double>(means_[0].count());
    // The sum of squares about each pixel's mean is the sum of all squares less those of the means.
    double squares = squares_;
    for (const std::vector<double>& sums : sums_) {
        for (const double sum : sums) {
            squares -= sum * sum / images;
        }
    }
    const double numbers = 3.0 * static_cast<double>(sums_[0].size());
    return std::sqrt(std::max(squares, 0.0) / (numbers * images * (images - 1.0)));
}

double BiasEstimator::tile_standard_error() const
{
    double squares = 0.0;
    for (const std::vector<Moments>& tiles : tile_means_) {
        for (const Moments& tile : tiles) {
            squares += tile.standard_error() * tile.standard_error();
        }
    }
    return std::sqrt(squares / (3.0 * static_cast<double>(tiles_.size())));
}

std::vector<TileBias> BiasEstimator::tile_tests() const
{
    std::vector<TileBias> result;
    std::vector<double> p;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        for (std::size_t c = 0; c < tile_means_.size(); ++c) {
            const Moments& moments = tile_means_[c][t];
            const std::optional<MeanTest> test = test_zero_mean(moments);
            if (!test) {
                return {};
            }
            result.push_back({.tile = tiles_[t],
                              .channel = static_cast<int>(c),
                              .bias = moments.mean(),
                              .standard_error = moments.standard_error(),
                              .t = test->t});
            p.push_back(test->p);
        }
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].p = adjusted[i];
    }
    // All have equal degrees of freedom, so the greatest t has the lowest p.
    std::stable_sort(result.begin(), result.end(), [](const TileBias& a, const TileBias& b) {
        return std::abs(a.t) > std::abs(b.t);
    });
    return result;
}

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
