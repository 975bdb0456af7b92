#include "compare/tiles.h"

#include <bdpt/eval/comparison.h>
#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace bdpt::eval {
namespace {

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

}  // namespace bdpt::eval
