#include "pilot/errors/visible_lights.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

std::vector<PilotLamp> by_pixel(const PilotContributions& contributions)
{
    std::vector<PilotLamp> lamps;
    for (const PilotRow& row : contributions.rows) {
        lamps.insert(lamps.end(), row.lamps().begin(), row.lamps().end());
    }
    // Stable, so that sums are bit-identical.
    std::stable_sort(lamps.begin(), lamps.end(), [](const PilotLamp& a, const PilotLamp& b) {
        return std::pair(a.y, a.x) < std::pair(b.y, b.x);
    });
    return lamps;
}

/// Returns the variance of hits in one pixel that the light partly fills, as far as Sobol points
/// leave it [nit^2].
double variance_of_hits(std::span<const PilotLamp> pixel, double points_per_pixel)
{
    constexpr double qmc_variance_factor = 0.25;  // as for direct light
    double light = 0.0;
    double filled = 0.0;
    for (const PilotLamp& lamp : pixel) {
        light += lamp.value / points_per_pixel;
        filled += lamp.value / (points_per_pixel * lamp.radiance);
    }
    if (!(filled > 0.0)) {
        return 0.0;
    }
    const double radiance = light / filled;
    const double part = std::min(1.0, filled);
    return qmc_variance_factor * radiance * radiance * part * (1.0 - part);
}

}  // namespace

VisibleLightErrors visible_light_errors(const PilotContributions& contributions,
                                        const PilotBrightness& brightness,
                                        const RenderOptions& options)
{
    const double samples = options.bidirectional.visible_light_samples;
    const auto weight = [&](const PilotLamp& lamp) {
        const double odds = samples * lamp.odds;
        const double raised = options.transport.heuristic == Heuristic::power ? odds * odds : odds;
        return raised / (1.0 + raised);
    };
    const double points = contributions.camera_paths();
    const double pixels = contributions.grid.pixels();
    const std::vector<PilotLamp> lamps = by_pixel(contributions);
    VisibleLightErrors errors;
    for (auto first = lamps.begin(); first != lamps.end();) {
        const auto last = std::find_if(first, lamps.end(), [first](const PilotLamp& lamp) {
            return lamp.x != first->x || lamp.y != first->y;
        });
        const double hits = brightness.scale(first->cell) *
                            variance_of_hits({first, last}, points / pixels) / pixels;
        errors.by_hits += hits;
        const double left = 1.0 - weight(*first);
        errors.by_both += left * left * hits;
        for (; first != last; ++first) {
            const double weighted = weight(*first) * first->value;
            errors.by_both +=
                brightness.scale(first->cell) * weighted * weighted / (samples * points);
        }
    }
    return errors;
}

}  // namespace bdpt
