#include "rates/rate_map.h"

#include "rates/fitting_exponents.h"
#include "rates/plane.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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
