#include "metrics/aces_curve.h"

#include <bdpt/eval/metric.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::eval {

FlipExposures flip_exposures(const Image& reference)
{
    constexpr double shown = 0.85;     // display value of the brightest and of the median luminance
    constexpr double least = 0x1p-23;  // minimum median: a screen shows nothing darker
    std::vector<double> luminances;
    luminances.reserve(reference.pixels.size());
    for (const Rgb& pixel : reference.pixels) {
        luminances.push_back(0.2126 * static_cast<double>(pixel.r) +
                             0.7152 * static_cast<double>(pixel.g) +
                             0.0722 * static_cast<double>(pixel.b));
    }
    const double greatest = *std::max_element(luminances.begin(), luminances.end());
    if (!(greatest > 0.0)) {
        return {};
    }
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    const double bright = AcesCurve::inverse(shown);
    FlipExposures result;
    result.start = std::log2(bright / greatest);
    result.stop = std::max(result.start, std::log2(bright / std::max(*middle, least)));
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
    return result;
}

}  // namespace bdpt::eval
