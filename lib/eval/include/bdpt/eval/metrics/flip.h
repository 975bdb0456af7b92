#pragma once

/// @file
/// Measures the differences that people see between two images.
///
/// @code{.cpp}
/// void print_flip(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     const bdpt::eval::FlipExposures exposures = bdpt::eval::flip_exposures(reference);
///     const bdpt::eval::ErrorMap map = bdpt::eval::hdr_flip(image, reference, exposures);
///     std::cout << "HDR-FLIP " << bdpt::eval::mean(map) << '\n';
/// }
/// @endcode

#include <bdpt/eval/metrics/error_map.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

namespace bdpt::eval {

/// Pixels per degree of visual angle of a 4K screen, 0.7 m wide, seen from 0.7 m [Andersson et al.
/// 2020, sec. 4].
inline constexpr double default_pixels_per_degree = 67.0206432765823;

/// Computes the difference that people perceive when two images of one size alternate on a screen,
/// from 0 (none) to 1 [Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images].
/// Pixels are linear light of an sRGB screen; they are clamped to [0, 1].
[[nodiscard]] BDPT_EXPORT ErrorMap flip(const Image& image, const Image& reference,
                                        double pixels_per_degree = default_pixels_per_degree);

/// Exposures [EV] of HDR-FLIP: `count` of them, evenly spaced from `start` to `stop`.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 1;

    /// Returns exposure `index` in [0, count).
    [[nodiscard]] double at(int index) const
    {
        return count > 1 ? start + (stop - start) * index / (count - 1) : start;
    }
};

/// Returns exposures from the one that shows the brightest pixel of `reference` at 0.85 to the one
/// that shows the median there, about one EV apart, at least two [Andersson et al. 2021,
/// Visualizing and Communicating Errors in Rendered Images, sec. 4]. A median below 2^-23 counts as
/// 2^-23. A black image has one exposure, 0 EV.
[[nodiscard]] BDPT_EXPORT FlipExposures flip_exposures(const Image& reference);

/// Computes HDR-FLIP [Andersson et al. 2021]: for each pixel the greatest `flip` over all
/// exposures, tone mapped by the ACES curve [Narkowicz 2016]. Pixels are scene-linear; negative
/// ones count as 0.
[[nodiscard]] BDPT_EXPORT ErrorMap hdr_flip(const Image& image, const Image& reference,
                                            const FlipExposures& exposures,
                                            double pixels_per_degree = default_pixels_per_degree);

}  // namespace bdpt::eval
