#pragma once

/// @file
/// Compares images with a reference, in memory or in files: errors, bias, the worst tiles; decides
/// whether they are good enough.
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
///
/// @code{.cpp}
/// bool is_good_enough(const bdpt::eval::ComparisonReport& report)
/// {
///     const auto threshold = bdpt::eval::parse_threshold("relmse=0.01");
///     return threshold && bdpt::eval::check_threshold(report, *threshold).passed;
/// }
/// @endcode
///
/// @code{.cpp}
/// const std::vector<std::filesystem::path> files = {"seed0.exr", "seed1.exr"};
/// const auto [report, warnings] = bdpt::eval::compare_files(files, "reference.exr", {}, {});
/// for (const bdpt::eval::MetricSummary& metric : report.metrics) {
///     std::cout << bdpt::eval::to_string(metric.metric) << ": " << metric.mean << '\n';
/// }
/// @endcode

#include <bdpt/eval/metric.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Estimates the bias of renders of one scene with different seeds: the difference of their mean
/// from a reference that is taken as the truth, for the whole image and for each tile.
class BDPT_EXPORT BiasEstimator {
public:
    /// Takes tiles of images of `width` x `height` pixels.
    BiasEstimator(int width, int height, std::vector<PixelRect> tiles);

    /// Adds an image; both have that size.
    void add(const Image& image, const Image& reference);

    /// Returns the bias of at least one image.
    [[nodiscard]] Bias bias() const;
    /// Returns a test for each tile and channel, in order of increasing p; none for one image.
    [[nodiscard]] std::vector<TileBias> tile_tests() const;

private:
    [[nodiscard]] Bias bias_of_one() const;
    [[nodiscard]] double pixel_standard_error() const;
    [[nodiscard]] double tile_standard_error() const;

    int width_;
    int height_;
    std::vector<PixelRect> tiles_;
    std::array<std::vector<double>, 3> sums_;  // sums of differences; one per pixel, by channel
    double squares_ = 0.0;          // sum of squared differences, over pixels, channels and images
    std::array<Moments, 4> means_;  // red, green, blue, and their mean
    std::array<std::vector<Moments>, 3> tile_means_;  // one per tile, by channel
};

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

/// Quantity that a threshold limits.
enum class ThresholdKind : std::uint8_t {
    metric,  ///< mean of the metric over the images
    bias,    ///< greatest absolute bias of the three channels
    p,       ///< lowest p of all tiles
};

/// The worst value that passes.
struct Threshold {
    ThresholdKind kind = ThresholdKind::metric;
    Metric metric = Metric::relmse;  ///< if `kind` is metric
    double limit = 0.0;              ///< minimum of psnr or p, maximum of other quantities
};

/// Parses "NAME=VALUE", where NAME is a metric, "bias" or "p". Returns none for anything else.
[[nodiscard]] BDPT_EXPORT std::optional<Threshold> parse_threshold(std::string_view text);

/// Result of a threshold.
struct ThresholdResult {
    std::string name;
    double limit = 0.0;
    double value = 0.0;
    bool passed = false;
};

/// Checks a report against a threshold. Throws `Error` (usage) if the report does not have the
/// metric, or has a single image and so no p.
[[nodiscard]] BDPT_EXPORT ThresholdResult check_threshold(const ComparisonReport& report,
                                                          const Threshold& threshold);

/// Returns the report as a JSON object, as described in docs/compare.md. Numbers that are not
/// finite are null. `image` and `reference` are their names as the user gave them.
[[nodiscard]] BDPT_EXPORT std::string comparison_json(const ComparisonReport& report,
                                                      std::span<const ThresholdResult> thresholds,
                                                      const std::string& image,
                                                      const std::string& reference);

/// Returns the images to compare with `reference`: `path` itself, or if it is a folder, all .exr
/// and .hdr files in it except the reference and hidden ones, sorted by name. Throws `Error`
/// (not_found) if the folder cannot be read or holds none.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> seed_files(
    const std::filesystem::path& path, const std::filesystem::path& reference);

/// The result of `compare_files`.
struct FileComparison {
    ComparisonReport report;
    std::vector<std::string> warnings;  ///< one line each, with the file's name
};

/// Reads the images one at a time and compares them with the reference, within the region for which
/// both the reference and the first image have data; the other images must have data for all of it.
/// `layer` is that of `io::ImageOptions`; x0 and y0 of the options are set from the files.
///
/// Throws `Error`, whose message names the file: those of `io::read_image` and `Comparison`, and
/// invalid_input for images of different size or without pixels in common.
[[nodiscard]] BDPT_EXPORT FileComparison compare_files(std::span<const std::filesystem::path> files,
                                                       const std::filesystem::path& reference,
                                                       const std::optional<std::string>& layer,
                                                       const ComparisonOptions& options);

}  // namespace bdpt::eval
