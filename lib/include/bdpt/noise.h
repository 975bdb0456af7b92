#pragma once

#include <bdpt/export.h>
#include <bdpt/film/film.h>

#include <cstdint>

namespace bdpt {

/// How noisy a film's image is: the relative standard error that 95 % of its tiles are not above; 0
/// is clean, 0.02 is 2 %.
///
/// Tiles are squares of about 16 x 16 pixels. The error of one is that of its pixels' luminance,
/// root mean square, over its mean luminance or, in dark tiles, over 1 % of the image's. It is
/// estimated from the difference of the film's halves [Dammertz et al. 2010, "A Hierarchical
/// Automatic Stopping Condition for Monte Carlo Global Illumination"], splats included. Tiles whose
/// halves are equal to the bit do not count: empty background would hide the rest. A few tiles with
/// fireflies do not decide, and neither does what no sample has found yet.
///
/// It is right for halves of equally many samples, as render() has them whenever it looks. Infinite
/// when there are less than two samples, or the image is black. The same for any number of threads.
[[nodiscard]] BDPT_EXPORT double noise_of(const Film& film);

/// The first number of samples a pixel after `samples` at which a render looks at its noise: 16,
/// 24, 32, 48, 64, 96, ... (2^k and 3 * 2^(k - 1), in which both halves have Sobol points that are
/// well spread).
[[nodiscard]] BDPT_EXPORT std::int64_t next_noise_look(std::int64_t samples);

/// Is `samples` such a number?
[[nodiscard]] BDPT_EXPORT bool is_noise_look(std::int64_t samples);

/// The number of samples a pixel after which a film will probably have the noise `goal`, if it had
/// `noise` after `samples`: the first at which a render looks by error ~ 1 / sqrt(samples). At most
/// 2^31.
[[nodiscard]] BDPT_EXPORT std::int64_t samples_for_noise(double noise, std::int64_t samples,
                                                         double goal);

}  // namespace bdpt
