#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/part/sample_rates.h>

#include <string>
#include <vector>

namespace bdpt::app {

// Scalars as images: red is the position on a false-colour scale, in [0, 1].

/// A labelled position on a scale.
struct Tick {
    double place = 0.0;  ///< in [0, 1]
    std::string text;
};

/// Legend of false colours.
struct Scale {
    std::string label;
    std::vector<Tick> ticks;
};

/// Returns the noise by blocks of 8 x 8 pixels: the standard error of a pixel (root mean square)
/// relative to the block's mean, which counts as at least 1 % of the image's mean. Black before
/// there are two samples.
[[nodiscard]] Image noise_image(const Film& film);
[[nodiscard]] Scale noise_scale();

/// Returns the number of samples per round of pixels in the film's region.
[[nodiscard]] Image rates_image(const SampleRates& rates, const PixelRect& region);
[[nodiscard]] Scale rates_scale();

}  // namespace bdpt::app
