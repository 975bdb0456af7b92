#pragma once

/// @file
/// Holds the results of a comparison.
///
/// @code{.cpp}
/// void print_biased_tiles(const bdpt::eval::ComparisonReport& report)
/// {
///     for (const bdpt::eval::TileBias& tile : report.biased_tiles) {
///         std::cout << tile.tile.x0 << ',' << tile.tile.y0 << ": p " << tile.p << '\n';
///     }
/// }
/// @endcode

#include <bdpt/eval/metrics/error_map.h>
#include <bdpt/eval/metrics/metric.h>
#include <bdpt/eval/metrics/metric_scale.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::eval {

/// Metrics of one image, in the order of the report's.
struct ImageErrors {
    std::string name;
    std::vector<double> values;
};

/// Statistics of a metric over all images.
struct MetricSummary {
    Metric metric = Metric::relmse;
    double mean = 0.0;
    std::optional<double> deviation{};  ///< standard deviation; none for one image
    double least = 0.0;
    double greatest = 0.0;
};

/// An estimate with its standard error.
struct Estimate {
    double value = 0.0;
    std::optional<double> standard_error{};
};

/// Source of the standard errors of the bias.
enum class BiasSource : std::uint8_t {
    seeds,   ///< spread between images of different seeds
    blocks,  ///< spread between blocks of pixels of a single image; noise must not correlate beyond
             ///< a block
};

/// Mean of image minus reference: for red, green, blue, and the mean of the three.
struct Bias {
    BiasSource source = BiasSource::blocks;
    std::array<Estimate, 4> channels;
    /// Root mean square over pixels and channels, and over tiles and channels; none for one image.
    std::optional<double> pixel_standard_error{};
    std::optional<double> tile_standard_error{};
};

/// A tile and the metric in it, averaged over the images.
struct TileError {
    PixelRect tile{};  ///< position in the whole image
    double value = 0.0;
};

/// A tile and the test whether its mean differs from the reference's.
struct TileBias {
    PixelRect tile{};  ///< position in the whole image
    int channel = 0;   ///< 0 to 2: red, green, blue
    double bias = 0.0;
    double standard_error = 0.0;
    double t = 0.0;  ///< bias / standard_error
    double p = 1.0;  ///< p of Student's t-test, Holm-corrected for all tiles and channels
};

/// Results of the comparison of images with a reference.
struct ComparisonReport {
    PixelRect region;  ///< compared region, in the whole image
    MetricScale scale;
    std::vector<ImageErrors> images;
    std::vector<MetricSummary> metrics;
    Bias bias;
    int tile_size = 0;
    Metric map_metric = Metric::relmse;
    std::vector<TileError> worst_tiles;  ///< by `map_metric`, the worst first
    std::vector<TileBias> biased_tiles;  ///< the lowest p first; empty for one image
    /// `map_metric` of each pixel, from the mean of the terms over all images.
    ErrorMap map;
};

}  // namespace bdpt::eval
