#include "integrator/path/light_techniques.h"

#include <algorithm>

namespace bdpt {

float mis_weight(const TechniqueDensities& densities, LightTechnique used, Heuristic heuristic)
{
    const float own = densities[static_cast<std::size_t>(used)];
    if (!(own > 0.0f)) {
        return 0.0f;
    }
    const auto greatest = std::max_element(densities.begin(), densities.end());
    if (heuristic == Heuristic::maximum) {
        const auto first = static_cast<std::size_t>(greatest - densities.begin());
        return static_cast<std::size_t>(used) == first ? 1.0f : 0.0f;
    }
    constexpr float cutoff = 0.1f;  // alpha [Veach 1997, sec. 9.2.3.2]
    if (heuristic == Heuristic::cutoff && own < cutoff * *greatest) {
        return 0.0f;
    }
    // Excludes its own ratio, as its density may be infinite.
    float sum = 1.0f;
    for (std::size_t i = 0; i < densities.size(); ++i) {
        const float density = densities[i];
        if (i == static_cast<std::size_t>(used) ||
            (heuristic == Heuristic::cutoff && density < cutoff * *greatest)) {
            continue;
        }
        const float ratio = density / own;
        sum += heuristic == Heuristic::power     ? ratio * ratio
               : heuristic == Heuristic::uniform ? (density > 0.0f ? 1.0f : 0.0f)
                                                 : ratio;
    }
    return 1.0f / sum;
}

}  // namespace bdpt
