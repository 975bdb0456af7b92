#pragma once

/// @file
/// Estimates the bias of renders with different seeds.
///
/// @code{.cpp}
/// const bdpt::Image reference = bdpt::io::read_image("reference.exr").image;
/// const bdpt::PixelRect all = {.x1 = reference.width, .y1 = reference.height};
/// bdpt::eval::BiasEstimator estimator(all.x1, all.y1, {all});
/// for (const char* file : {"seed0.exr", "seed1.exr"}) {
///     estimator.add(bdpt::io::read_image(file).image, reference);
/// }
/// std::cout << estimator.bias().channels[3].value << " nit\n";
/// @endcode

#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/eval/statistics/moments.h>
#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <vector>

namespace bdpt::eval {

/// Estimates how far the mean of renders of one scene, with different seeds, is from a reference
/// that is taken as the truth: in all, and in each tile.
class BDPT_EXPORT BiasEstimator {
public:
    /// The tiles lie in images of `width` x `height` pixels.
    BiasEstimator(int width, int height, std::vector<PixelRect> tiles);

    /// Both have that size.
    void add(const Image& image, const Image& reference);

    /// The bias of at least one image.
    [[nodiscard]] Bias bias() const;
    /// A test for each tile and channel, the surest bias first; none for one image.
    [[nodiscard]] std::vector<TileBias> tile_tests() const;

private:
    [[nodiscard]] Bias bias_of_one() const;
    [[nodiscard]] double pixel_standard_error() const;
    [[nodiscard]] double tile_standard_error() const;

    int width_;
    int height_;
    std::vector<PixelRect> tiles_;
    std::array<std::vector<double>, 3> sums_;  // of differences; a number a pixel, by channel
    double squares_ = 0.0;                     // of differences, over pixels, channels and images
    std::array<Moments, 4> means_;             // red, green, blue, and their mean
    std::array<std::vector<Moments>, 3> tile_means_;  // a number a tile, by channel
};

}  // namespace bdpt::eval
