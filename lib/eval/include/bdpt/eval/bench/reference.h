#pragma once

/// @file
/// Makes references from renders, and tells how noisy they are.
///
/// @code{.cpp}
/// void print_noise(const bdpt::Film& film)
/// {
///     const bdpt::eval::HalvedImage render = {
///         .image = film.develop(), .first = film.develop_half(0), .second = film.develop_half(1)};
///     std::cout << "relMSE of its noise: " << bdpt::eval::noise_of(render, render.image) << '\n';
/// }
/// @endcode

#include <bdpt/eval/metrics/metric_scale.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <string>

namespace bdpt::eval {

/// The best known limit of the images of a scene.
struct Reference {
    Image image;
    double noise = 0.0;  ///< relMSE that its own noise adds to that of every image
    std::string origin;  ///< for people: how it came about
};

/// Scale of relMSE and MAPE in benchmarks: epsilon is 0.01 of the reference's mean, so that the
/// unit of light does not matter. Throws `Error` (invalid_input) for a black reference.
[[nodiscard]] BDPT_EXPORT MetricScale bench_scale(const Image& reference);

/// An image and the two halves of the samples that it is the mean of.
struct HalvedImage {
    Image image;
    Image first;
    Image second;
};

/// relMSE of an image's own noise, as its halves tell it, relative to `base` of the same size.
/// Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT double noise_of(const HalvedImage& image, const Image& base);

/// The combination of two renders by different integrators.
struct CombinedReference {
    Image image;
    double noise = 0.0;      ///< relMSE
    double share = 0.0;      ///< weight of the first image, by the inverse of its noise
    double agreement = 0.0;  ///< squared difference of the two over what their noise explains
};

/// The mean of both, weighted by what the halves tell of their noise. If they differ by more than
/// that explains (`agreement` above 2) the second does not see all light, and the first counts
/// alone. Sizes are equal. Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT CombinedReference combine(const HalvedImage& all_light,
                                                    const HalvedImage& most_light);

}  // namespace bdpt::eval
