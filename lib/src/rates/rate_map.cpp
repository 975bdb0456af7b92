#include "rates/rate_map.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>

namespace bdpt {
namespace {

/// Combines values at most `radius` pixels away, along rows (`step` 1) or columns (`step` width).
template <typename Combine>
Plane along(const Plane& plane, PlaneSize size, bool rows, int radius, const Combine& combine)
{
    Plane result(plane.size());
    const int length = rows ? size.width : size.height;
    const auto step = static_cast<std::size_t>(rows ? 1 : size.width);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto width = static_cast<std::size_t>(size.width);
        const int at = static_cast<int>(rows ? i % width : i / width);
        const int first = std::max(0, at - radius);
        const int last = std::min(length - 1, at + radius);
        result[i] = combine(&plane[i - static_cast<std::size_t>(at - first) * step], step,
                            last - first + 1);
    }
    return result;
}

}  // namespace

Plane local_mean(const Plane& plane, PlaneSize size, int radius)
{
    const auto mean = [](const double* first, std::size_t step, int count) {
        double sum = 0.0;
        for (int i = 0; i < count; ++i) {
            sum += first[static_cast<std::size_t>(i) * step];
        }
        return sum / count;
    };
    return along(along(plane, size, true, radius, mean), size, false, radius, mean);
}

Plane local_greatest(const Plane& plane, PlaneSize size, int radius)
{
    const auto greatest = [](const double* first, std::size_t step, int count) {
        double result = *first;
        for (int i = 1; i < count; ++i) {
            result = std::max(result, first[static_cast<std::size_t>(i) * step]);
        }
        return result;
    };
    return along(along(plane, size, true, radius, greatest), size, false, radius, greatest);
}

double mean_of(const Plane& plane)
{
    double sum = 0.0;
    for (const double value : plane) {
        sum += value;
    }
    return sum / static_cast<double>(plane.size());
}

Plane local_mean(const Plane& plane, const Plane& weights, PlaneSize size, int radius)
{
    Plane products(plane.size());
    std::transform(plane.begin(), plane.end(), weights.begin(), products.begin(),
                   std::multiplies());
    Plane means = local_mean(products, size, radius);
    const Plane sums = local_mean(weights, size, radius);
    for (std::size_t i = 0; i < means.size(); ++i) {
        means[i] = sums[i] > 0.0 ? means[i] / sums[i] : plane[i];
    }
    return means;
}

double octaves_of(double value)
{
    constexpr double per_log = 1.44269504088896340736;
    constexpr double least = 1e-30;
    constexpr double greatest = 1e30;
    return per_log *
           static_cast<double>(log_exact(static_cast<float>(std::clamp(value, least, greatest))));
}

namespace {

constexpr double widest = 32.0;  // greatest distance of a wanted rate from 1 that counts [octaves]

}  // namespace

int dithered_step(double octaves, int x, int y)
{
    // Thresholds by the additive recurrence R2, whose neighbours differ much [Roberts 2018, "The
    // Unreasonable Effectiveness of Quasirandom Sequences"].
    const std::uint32_t threshold = (static_cast<std::uint32_t>(x) * 0xc13fa9a9U +
                                     static_cast<std::uint32_t>(y) * 0x91e10da6U) >>
                                    (32U - log2_of_steps);
    return static_cast<int>(std::lround(std::clamp(octaves, -widest, widest) * steps_of_octave)) +
           static_cast<int>(threshold);
}

SampleRates rates_of_steps(PlaneSize size, const std::vector<int>& steps, ExponentRange range)
{
    // How many pixels have each step or a higher one.
    constexpr int lowest = -static_cast<int>(widest) * steps_of_octave;
    constexpr int count = 2 * -lowest + 2 * steps_of_octave;
    std::vector<std::int64_t> at_least(count + 1);
    for (const int step : steps) {
        ++at_least[static_cast<std::size_t>(step - lowest)];
    }
    std::partial_sum(at_least.rbegin(), at_least.rend(), at_least.rbegin());
    const auto pixels = static_cast<std::int64_t>(steps.size());
    // The sum of the rates [quarters] if `shift` steps are added to all.
    const auto sum = [&](int shift) {
        std::int64_t result = pixels << (range.min - SampleRates::min_exponent);
        for (int e = range.min + 1; e <= range.max; ++e) {
            const int step = std::clamp(e * steps_of_octave - shift - lowest, 0, count);
            result += at_least[static_cast<std::size_t>(step)]
                      << (e - 1 - SampleRates::min_exponent);
        }
        return result;
    };
    int low = -2 * count;  // all have the least rate
    int high = 2 * count;
    while (low + 1 < high) {
        const int middle = low + (high - low) / 2;
        (sum(middle) <= pixels << -SampleRates::min_exponent ? low : high) = middle;
    }
    std::vector<std::int8_t> exponents;
    exponents.reserve(steps.size());
    for (const int step : steps) {
        const int octave = (step + low) >> log2_of_steps;  // rounds down
        exponents.push_back(static_cast<std::int8_t>(std::clamp(octave, range.min, range.max)));
    }
    return {size.width, size.height, std::move(exponents)};
}

namespace {

// A few samples say little about one pixel, so variances are averaged over a neighbourhood; and
// rare bright samples missed in one neighbourhood may be found in the next, so the maximum of
// nearby ones counts. Wider ones blur the boundaries of small glossy parts.
constexpr int mean_radius = 3;  // 7 x 7 pixels
constexpr int max_radius = 1;   // 3 x 3 pixels
constexpr double dark = 0.01;   // relative to the image's mean luminance, as in estimate_noise()
/// Error that each pixel has beside the pilot's estimate, as a fraction of the mean error. Rare
/// bright paths also occur where the pilot has not found them; and where they dominate the error,
/// this makes rates uniform.
constexpr double unseen_share = 0.25;

/// Returns the logarithms, to base 2, of values to which the rates should be proportional.
Plane wanted_octaves(const RateEvidence& evidence)
{
    const PlaneSize size{.width = evidence.width, .height = evidence.height};
    const Plane brightness = local_mean(evidence.brightness, size, mean_radius);
    const double eps = dark * mean_of(evidence.brightness);
    Plane relative(brightness.size(), 0.0);
    for (std::size_t i = 0; i < relative.size(); ++i) {
        const double scale = brightness[i] * brightness[i] + eps * eps;
        relative[i] = scale > 0.0 ? evidence.variance[i] / scale : 0.0;
    }
    Plane wanted = local_greatest(local_mean(relative, size, mean_radius), size, max_radius);
    const double unseen = unseen_share * mean_of(relative);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i] = octaves_of((wanted[i] + unseen) / evidence.cost[i]) / 2.0;
    }
    return wanted;
}

}  // namespace

SampleRates rates_for(const RateEvidence& evidence)
{
    const Plane wanted = wanted_octaves(evidence);
    const auto width = static_cast<std::size_t>(evidence.width);
    return dithered_rates({.width = evidence.width, .height = evidence.height}, [&](int x, int y) {
        return wanted[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
    });
}

}  // namespace bdpt
