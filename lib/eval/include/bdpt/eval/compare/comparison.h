#pragma once

/// @file
/// Compares images in memory with a reference.
///
/// @code{.cpp}
/// void print_worst_tile(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     bdpt::eval::Comparison comparison("reference", reference, {.tile_size = 16});
///     comparison.add("image", image);
///     const bdpt::eval::TileError worst = comparison.report().worst_tiles.at(0);
///     std::cout << worst.tile.x0 << ',' << worst.tile.y0 << ": " << worst.value << '\n';
/// }
/// @endcode

#include <bdpt/eval/compare/bias_estimator.h>
#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/eval/metrics/metric.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::eval {

/// Options of a comparison.
struct ComparisonOptions {
    std::vector<Metric> metrics{all_metrics.begin(), all_metrics.end()};
    MetricOptions scale{};
    /// Metric of the error map and of the worst tiles; not psnr.
    Metric map_metric = Metric::relmse;
    int tile_size = 32;   ///< side of a tile [pixels], at least 1
    int worst_tiles = 5;  ///< maximum number of tiles to report; at least 1
    /// Position of the images in the whole image [pixels], for messages and reported tiles.
    int x0 = 0;
    int y0 = 0;
};

/// Compares images, one after the other, with a reference. The images are renders of one scene with
/// different seeds; the reference is taken as the truth.
class BDPT_EXPORT Comparison {
public:
    /// Takes the reference; `name` is for messages. Throws `Error`: usage for invalid options,
    /// invalid_input for a reference without pixels or with NaN or infinity.
    Comparison(const std::string& name, Image reference, ComparisonOptions options);

    /// Adds an image. Throws `Error` (invalid_input) if its size differs from the reference's, or
    /// if it has NaN or infinity.
    void add(const std::string& name, const Image& image);

    /// Returns the statistics of at least one image.
    [[nodiscard]] ComparisonReport report() const;

private:
    [[nodiscard]] std::vector<TileError> worst_tiles(const ErrorMap& terms) const;
    [[nodiscard]] std::vector<TileBias> biased_tiles() const;
    [[nodiscard]] MetricSummary summarize(std::size_t metric) const;
    /// Converts a rectangle of the compared images to one of the whole image.
    [[nodiscard]] PixelRect placed(const PixelRect& rect) const;

    Image reference_;
    std::string reference_name_;
    ComparisonOptions options_;
    MetricScale scale_;
    std::vector<PixelRect> tiles_;
    std::vector<ImageErrors> images_;
    std::vector<double> map_sum_;  // sum over images of the terms of map_metric, one per pixel
    BiasEstimator bias_;
};

}  // namespace bdpt::eval
