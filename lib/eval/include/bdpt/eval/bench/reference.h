#pragma once

/// @file
/// Makes references from renders, and tells how noisy they are.
///
/// @code{.cpp}
/// void print_noise(const bdpt::Film& film)
/// {
///     const bdpt::eval::HalvedImage render = {
///         .image = film.develop(), .first = film.develop_half(0), .second = film.develop_half(1)};
///     const double noise = bdpt::eval::estimate_noise(render, render.image);
///     std::cout << "relMSE of its noise: " << noise << '\n';
/// }
/// @endcode

#include <bdpt/eval/metrics/metric_scale.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <string>

namespace bdpt::eval {

/// The reference image of a scene: the best known estimate of the limit of its renders.
struct Reference {
    Image image;
    /// relMSE that the reference's own noise adds to every image compared with it.
    double noise = 0.0;
    std::string origin;  ///< origin of the image, for people
};

/// Returns the scale of relMSE and MAPE in benchmarks: epsilon is 0.01 of the reference's mean,
/// which makes errors independent of the unit of light. Throws `Error` (invalid_input) for a black
/// reference.
[[nodiscard]] BDPT_EXPORT MetricScale bench_scale(const Image& reference);

/// An image and the two half images whose mean it is.
struct HalvedImage {
    Image image;
    Image first;
    Image second;
};

/// Returns the relMSE of an image's own noise, estimated from its halves, relative to `base` of the
/// same size. Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT double estimate_noise(const HalvedImage& image, const Image& base);

/// Combination of two renders by different integrators.
struct CombinedReference {
    Image image;
    double noise = 0.0;  ///< relMSE
    double share = 0.0;  ///< weight of the first image, by inverse noise
    /// Squared difference of the two images over the one expected from their noise.
    double agreement = 0.0;
};

/// Returns the mean of both images, weighted by the inverse of the noise that their halves show. If
/// they differ by more than that noise explains (`agreement` above 2), the second lacks light and
/// the first is taken alone. Sizes are equal. Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT CombinedReference combine(const HalvedImage& all_light,
                                                    const HalvedImage& most_light);

}  // namespace bdpt::eval
