#include "rates/rate_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

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

namespace {

/// Returns the exponent of the power of two nearest to `rate`, by its logarithm.
std::int8_t find_exponent(double rate, ExponentRange range)
{
    constexpr double root = 1.4142135623730951;
    constexpr std::array borders{0.25 * root, 0.5 * root, root, 2.0 * root};
    int exponent = SampleRates::min_exponent;
    for (const double border : borders) {
        exponent += rate >= border ? 1 : 0;
    }
    return static_cast<std::int8_t>(std::clamp(exponent, range.min, range.max));
}

/// Returns 2^exponent [quarters].
std::int64_t to_quarters(int exponent)
{
    return std::int64_t{1} << (exponent - SampleRates::min_exponent);
}

/// Chooses exponents of rates that are a scale times the wanted ones.
class ScaledRates {
public:
    ScaledRates(const Plane& wanted, const std::vector<std::int64_t>& pixels, ExponentRange range)
        : wanted_(wanted), pixels_(pixels), range_(range)
    {}

    [[nodiscard]] std::int64_t pixels(std::size_t i) const
    {
        return pixels_.empty() ? 1 : pixels_[i];
    }
    [[nodiscard]] std::int8_t exponent(std::size_t i, double scale) const
    {
        return find_exponent(scale * wanted_[i], range_);
    }
    /// Returns the sum of the rates of all pixels [quarters].
    [[nodiscard]] std::int64_t sum(double scale) const
    {
        std::int64_t result = 0;
        for (std::size_t i = 0; i < wanted_.size(); ++i) {
            result += pixels(i) * to_quarters(exponent(i, scale));
        }
        return result;
    }
    /// Returns that sum for a mean rate of 1.
    [[nodiscard]] std::int64_t most() const
    {
        const auto size = static_cast<std::int64_t>(wanted_.size());
        return (pixels_.empty() ? size
                                : std::accumulate(pixels_.begin(), pixels_.end(), std::int64_t{0}))
               << -SampleRates::min_exponent;
    }

private:
    const Plane& wanted_;
    const std::vector<std::int64_t>& pixels_;
    ExponentRange range_;
};

/// Adjacent scales for which the mean is at most 1, and above 1.
struct BordersOfScale {
    double low;
    double high;
};

BordersOfScale borders_of_scale(const ScaledRates& rates, double mean)
{
    constexpr double widest = 0x1p40;
    constexpr int halvings = 60;
    const std::int64_t most = rates.most();
    BordersOfScale borders{.low = 1.0 / (widest * mean), .high = widest / mean};
    for (int i = 0; i < halvings; ++i) {
        const double middle = std::sqrt(borders.low * borders.high);
        (rates.sum(middle) <= most ? borders.low : borders.high) = middle;
    }
    return borders;
}

/// Returns a number that differs for all elements; those with the smallest ones are evenly
/// distributed.
std::uint64_t spread(std::size_t element)
{
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;
    return element * golden_ratio;
}

}  // namespace

std::vector<std::int8_t> fitting_exponents(const Plane& wanted,
                                           const std::vector<std::int64_t>& pixels,
                                           ExponentRange range)
{
    const ScaledRates rates(wanted, pixels, range);
    const auto [low, high] = borders_of_scale(rates, mean_of(wanted));
    std::vector<std::int8_t> exponents(wanted.size());
    std::vector<std::size_t> ties;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        exponents[i] = rates.exponent(i, low);
        if (exponents[i] != rates.exponent(i, high)) {
            ties.push_back(i);
        }
    }
    // Of elements that want the same rate only some can have more: they are distributed over the
    // image.
    std::sort(ties.begin(), ties.end(),
              [](std::size_t a, std::size_t b) { return spread(a) < spread(b); });
    std::int64_t left = rates.most() - rates.sum(low);
    for (const std::size_t i : ties) {
        const std::int64_t more = rates.pixels(i) * to_quarters(exponents[i]);
        if (more > left) {
            break;
        }
        left -= more;
        ++exponents[i];
    }
    return exponents;
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

/// Returns values to which the rates should be proportional.
Plane wanted_rates(const RateEvidence& evidence)
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
        wanted[i] = std::sqrt((wanted[i] + unseen) / evidence.cost[i]);
    }
    return wanted;
}

}  // namespace

SampleRates rates_for(const RateEvidence& evidence)
{
    const Plane wanted = wanted_rates(evidence);
    if (!(mean_of(wanted) > 0.0)) {
        return {evidence.width, evidence.height, std::vector<std::int8_t>(wanted.size(), 0)};
    }
    return {evidence.width, evidence.height, fitting_exponents(wanted, {})};
}

}  // namespace bdpt
