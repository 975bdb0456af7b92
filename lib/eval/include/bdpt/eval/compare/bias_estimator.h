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

}  // namespace bdpt::eval
