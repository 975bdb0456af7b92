#pragma once

/// @file
/// Measures the noise of a film, and estimates how many samples a lower noise takes.
///
/// @code{.cpp}
/// void print_noise(const bdpt::Film& film)
/// {
///     const double noise = bdpt::estimate_noise(film);
///     const std::int64_t samples = bdpt::samples_for_noise(noise, film.sample_count(), 0.01);
///     std::cout << 100.0 * noise << " %, and 1 % after " << samples << " samples a pixel\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/film.h>

#include <cstdint>

namespace bdpt {

/// Returns the noise of a film's image: the 95th percentile of the relative standard error of its
/// tiles; 0 is clean, 0.02 is 2 %.
///
/// Tiles are squares of about 16 x 16 pixels. The error of a tile is the root mean square error of
/// its pixels' luminance over its mean luminance or, in dark tiles, over 1 % of the image's mean
/// luminance. It is estimated from the difference of the film's halves [Dammertz et al. 2010, "A
/// Hierarchical Automatic Stopping Condition for Monte Carlo Global Illumination"], splats
/// included. Tiles with an error below 0.01 % do not count unless all are so clean: a smooth sky or
/// an empty background would hide the rest. Where `aovs` have `Aov::alpha`, the image is judged
/// before a background as bright as what is opaque on average: on its own, a silhouette in a black
/// tile would be noisier than it looks. A few tiles with fireflies do not affect the result, and
/// neither does light that no sample has found yet.
///
/// The estimate is valid for halves of equally many samples, which render() ensures whenever it
/// measures the noise. Infinite if there are fewer than two samples, or if the image is black.
/// Independent of the number of threads.
[[nodiscard]] BDPT_EXPORT double estimate_noise(const Film& film, const AovFilm& aovs = {});

/// Returns the first number of samples per pixel after `samples` at which a render measures its
/// noise: 16, 24, 32, 48, 64, 96, ... (2^k and 3 * 2^(k - 1), for which both halves have
/// well-distributed Sobol points).
[[nodiscard]] BDPT_EXPORT std::int64_t next_noise_look(std::int64_t samples);

/// Tests whether a render measures its noise after `samples` samples per pixel.
[[nodiscard]] BDPT_EXPORT bool is_noise_look(std::int64_t samples);

/// Predicts the number of samples per pixel after which a film will reach the noise `goal`, given
/// `noise` after `samples`: the first number at which a render measures its noise, assuming error ~
/// 1 / sqrt(samples). At most 2^31.
[[nodiscard]] BDPT_EXPORT std::int64_t samples_for_noise(double noise, std::int64_t samples,
                                                         double goal);

}  // namespace bdpt
