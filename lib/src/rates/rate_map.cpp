#include "rates/rate_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace bdpt {
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

using Plane = std::vector<double>;

struct Size {
    int width;
    int height;
};

/// Combines values at most `radius` pixels away, along rows (`step` 1) or columns (`step` width).
template <typename Combine>
Plane along(const Plane& plane, Size size, bool rows, int radius, const Combine& combine)
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

Plane local_mean(const Plane& plane, Size size, int radius)
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

Plane local_greatest(const Plane& plane, Size size, int radius)
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

double compute_mean(const Plane& plane)
{
    double sum = 0.0;
    for (const double value : plane) {
        sum += value;
    }
    return sum / static_cast<double>(plane.size());
}

/// Returns values to which the rates should be proportional.
Plane wanted_rates(const RateEvidence& evidence)
{
    const Size size{.width = evidence.width, .height = evidence.height};
    const Plane brightness = local_mean(evidence.brightness, size, mean_radius);
    const double eps = dark * compute_mean(evidence.brightness);
    Plane relative(brightness.size(), 0.0);
    for (std::size_t i = 0; i < relative.size(); ++i) {
        const double scale = brightness[i] * brightness[i] + eps * eps;
        relative[i] = scale > 0.0 ? evidence.variance[i] / scale : 0.0;
    }
    Plane wanted = local_greatest(local_mean(relative, size, mean_radius), size, max_radius);
    const double unseen = unseen_share * compute_mean(relative);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i] = std::sqrt((wanted[i] + unseen) / evidence.cost[i]);
    }
    return wanted;
}

/// Returns the exponent of the power of two nearest to `rate`, by its logarithm.
std::int8_t find_exponent(double rate)
{
    constexpr double root = 1.4142135623730951;
    constexpr std::array borders{0.25 * root, 0.5 * root, root, 2.0 * root};
    int exponent = SampleRates::min_exponent;
    for (const double border : borders) {
        exponent += rate >= border ? 1 : 0;
    }
    return static_cast<std::int8_t>(exponent);
}

/// Returns the sum of the rates if they are `scale` times `wanted` [quarters].
std::int64_t quarters(const Plane& wanted, double scale)
{
    std::int64_t sum = 0;
    for (const double rate : wanted) {
        sum += std::int64_t{1} << (find_exponent(scale * rate) - SampleRates::min_exponent);
    }
    return sum;
}

/// Returns the adjacent scales for which the mean is at most 1, and above 1.
std::pair<double, double> borders_of_scale(const Plane& wanted)
{
    constexpr double widest = 0x1p40;
    constexpr int halvings = 60;
    const auto most = static_cast<std::int64_t>(wanted.size()) << -SampleRates::min_exponent;
    const double mean = compute_mean(wanted);
    double low = 1.0 / (widest * mean);
    double high = widest / mean;
    for (int i = 0; i < halvings; ++i) {
        const double middle = std::sqrt(low * high);
        (quarters(wanted, middle) <= most ? low : high) = middle;
    }
    return {low, high};
}

/// Returns a number that differs for all pixels; those with the smallest ones are evenly
/// distributed.
std::uint64_t spread(std::size_t pixel)
{
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;
    return pixel * golden_ratio;
}

}  // namespace

SampleRates rates_for(const RateEvidence& evidence)
{
    const Plane wanted = wanted_rates(evidence);
    std::vector<std::int8_t> exponents(wanted.size(), 0);
    if (!(compute_mean(wanted) > 0.0)) {
        return {evidence.width, evidence.height, std::move(exponents)};
    }
    const auto [low, high] = borders_of_scale(wanted);
    std::vector<std::size_t> ties;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        exponents[i] = find_exponent(low * wanted[i]);
        if (exponents[i] != find_exponent(high * wanted[i])) {
            ties.push_back(i);
        }
    }
    // Of pixels that want the same rate only some can have more: they are distributed over the
    // image.
    std::sort(ties.begin(), ties.end(),
              [](std::size_t a, std::size_t b) { return spread(a) < spread(b); });
    std::int64_t left = (static_cast<std::int64_t>(wanted.size()) << -SampleRates::min_exponent) -
                        quarters(wanted, low);
    for (const std::size_t i : ties) {
        const std::int64_t more = std::int64_t{1} << (exponents[i] - SampleRates::min_exponent);
        if (more > left) {
            break;
        }
        left -= more;
        ++exponents[i];
    }
    return {evidence.width, evidence.height, std::move(exponents)};
}

}  // namespace bdpt
