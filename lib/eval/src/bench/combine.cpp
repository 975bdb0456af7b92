#include <bdpt/eval/bench.h>

#include <algorithm>
#include <cstddef>

#include "bench/bench_parts.h"

namespace bdpt::eval {
namespace {

/// Disagreement above which noise does not explain the difference of two images.
constexpr double max_disagreement = 2.0;

/// Returns the mean of (a - b)^2 / (r^2 + e), where r is `base`.
double relative_difference(const Image& a, const Image& b, const Image& base, double epsilon)
{
    return relative_mean(base, epsilon, [&](std::size_t i, int c, double /*r*/) {
        const double d = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
        return d * d;
    });
}

Image mix(const Image& a, const Image& b, double share)
{
    Image result = a;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        result.pixels[i] =
            static_cast<float>(share) * a.pixels[i] + static_cast<float>(1.0 - share) * b.pixels[i];
    }
    return result;
}

}  // namespace

MetricScale bench_scale(const Image& reference)
{
    return make_scale(reference, {.epsilon = 0.01, .epsilon_unit = EpsilonUnit::reference_mean});
}

double estimate_noise(const HalvedImage& image, const Image& base)
{
    // The squared difference of two halves has four times the variance of their mean.
    return relative_difference(image.first, image.second, base, bench_scale(base).squared_epsilon) /
           4.0;
}

CombinedReference combine(const HalvedImage& all_light, const HalvedImage& most_light)
{
    const Image middle = mix(all_light.image, most_light.image, 0.5);
    const double epsilon = bench_scale(middle).squared_epsilon;
    const double noise_a = estimate_noise(all_light, middle);
    const double noise_b = estimate_noise(most_light, middle);
    const double noise = noise_a + noise_b;
    const double difference =
        relative_difference(all_light.image, most_light.image, middle, epsilon);
    // Two images without noise agree only if they are equal up to rounding.
    const double agreement = difference / std::max(noise, 1e-10);
    const double share = agreement > max_disagreement ? 1.0 : noise > 0.0 ? noise_b / noise : 0.5;
    CombinedReference result{.image = mix(all_light.image, most_light.image, share),
                             .noise = 0.0,
                             .share = share,
                             .agreement = agreement};
    const double rest = 1.0 - share;
    result.noise = share * share * estimate_noise(all_light, result.image) +
                   rest * rest * estimate_noise(most_light, result.image);
    return result;
}

}  // namespace bdpt::eval
