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

/// The metrics of one image, in the order of the report's.
struct ImageErrors {
    std::string name;
    std::vector<double> values;
};

/// A metric over all images.
struct MetricSummary {
    Metric metric = Metric::relmse;
    double mean = 0.0;
    std::optional<double> deviation{};  ///< standard deviation; none for one image
    double least = 0.0;
    double greatest = 0.0;
};

/// A number that was estimated.
struct Estimate {
    double value = 0.0;
    std::optional<double> standard_error{};
};

/// Where standard errors of the bias come from.
enum class BiasSource : std::uint8_t {
    seeds,   ///< the spread between images of different seeds
    blocks,  ///< the spread between blocks of pixels of the only image; noise must not reach over
             ///< a block
};

/// Mean of image minus reference: of red, green, blue, and of the mean of the three.
struct Bias {
    BiasSource source = BiasSource::blocks;
    std::array<Estimate, 4> channels;
    /// Root mean square over pixels (tiles) and channels; none for one image.
    std::optional<double> pixel_standard_error{};
    std::optional<double> tile_standard_error{};
};

/// A tile and the metric in it, averaged over the images.
struct TileError {
    PixelRect tile{};  ///< in the whole image
    double value = 0.0;
};

/// A tile and how sure it is that its mean differs from the reference's.
struct TileBias {
    PixelRect tile{};  ///< in the whole image
    int channel = 0;   ///< red, green, blue
    double bias = 0.0;
    double standard_error = 0.0;
    double t = 0.0;  ///< bias / standard_error
    double p = 1.0;  ///< of Student's t-test, Holm-corrected for all tiles and channels
};

/// All that is known about images that were held against a reference.
struct ComparisonReport {
    PixelRect region;  ///< what was compared, in the whole image
    MetricScale scale;
    std::vector<ImageErrors> images;
    std::vector<MetricSummary> metrics;
    Bias bias;
    int tile_size = 0;
    Metric map_metric = Metric::relmse;
    std::vector<TileError> worst_tiles;  ///< by `map_metric`, the worst first
    std::vector<TileBias> biased_tiles;  ///< the lowest p first; empty for one image
    /// `map_metric` of each pixel; of several images from the mean of their terms.
    ErrorMap map;
};

}  // namespace bdpt::eval
