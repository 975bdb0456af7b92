#pragma once

/// @file
/// Tells whether renders with rates have steps of noise that an eye sees, such as patches of coarse
/// grain on an even wall.
///
/// @code{.cpp}
/// void print_worst_step(const std::vector<bdpt::Image>& with_rates,
///                       const std::vector<bdpt::Image>& even, const bdpt::RenderResult& surfaces)
/// {
///     std::vector<bdpt::Layer> layers = surfaces.aovs.develop(surfaces.film);
///     for (bdpt::Layer& layer : surfaces.ids.develop(surfaces.film)) {
///         layers.push_back(std::move(layer));
///     }
///     const auto steps = bdpt::eval::noise_steps(with_rates, even, layers);
///     std::cout << steps.at(0).least() << " times the noise beside it\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace bdpt::eval {

/// Two neighbouring blocks of pixels on one surface, and how much their noise differs by rates.
struct NoiseStep {
    PixelRect first;
    PixelRect second;  ///< right of the first block, or below it
    /// Ratio of the blocks' noise with rates over their ratio with even sampling, or its inverse:
    /// at least 1.
    double ratio = 1.0;
    double standard_error = 0.0;  ///< of the ratio's logarithm

    /// Returns the step that is there with some certainty: three standard errors below the ratio, but
    /// at least 1.
    [[nodiscard]] double least() const
    {
        return std::max(1.0, ratio * std::exp(-3.0 * standard_error));
    }
};

/// Compares the local noise of renders with rates of samples (`SampleRates`) and without. The noise
/// of a block of 8 x 8 pixels is the standard deviation of luminance between seeds. Blocks begin
/// every 4 pixels. Two that touch count if all of their pixels show one object alone, if their mean
/// normals differ by at most 10 degrees and their mean albedos by at most 10 %, and if there is
/// noise in both. Standard errors are those of the jackknife over seeds.
///
/// `with_rates` and `even` have at least three images each, equally many, by the same seeds: most
/// samples are then the same, so that chance divides out. `layers` are those of the AOVs albedo,
/// normal and object ("CryptoObject00") of any of these renders, with many samples of them. Returns
/// the steps in order of decreasing `least`. Throws `Error`: usage for other numbers of images,
/// invalid_input for images or layers of different sizes, for missing layers, or for pixels that
/// are not finite.
[[nodiscard]] BDPT_EXPORT std::vector<NoiseStep> noise_steps(std::span<const Image> with_rates,
                                                             std::span<const Image> even,
                                                             std::span<const Layer> layers);

}  // namespace bdpt::eval
