#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/part/sample_rates.h>

#include <string>
#include <vector>

namespace bdpt::app {

// Numbers as images: red is the place on a scale of false colours, in [0, 1].

/// A number on a scale.
struct Tick {
    double place = 0.0;  ///< in [0, 1]
    std::string text;
};

/// What colours stand for.
struct Scale {
    std::string label;
    std::vector<Tick> ticks;
};

/// Noise by blocks of 8 x 8 pixels: the standard error of their mean over it, in dark ones over
/// 1 % of the image's. Black before there are two samples.
[[nodiscard]] Image noise_image(const Film& film);
[[nodiscard]] Scale noise_scale();

/// How many samples pixels of the film's region take in a round.
[[nodiscard]] Image rates_image(const SampleRates& rates, const PixelRect& region);
[[nodiscard]] Scale rates_scale();

}  // namespace bdpt::app
