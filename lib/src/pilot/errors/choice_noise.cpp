#include "pilot/errors/choice_noise.h"

#include <cstddef>

namespace bdpt {

PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    PerCandidate<double> of_choice{};
    PerCandidate<double> of_connections{};
    for (const PilotRow& row : contributions.rows) {
        for (const PilotContribution& path : row.joined()) {
            if (!path.shares.choice_is_known()) {
                continue;
            }
            const PathShares::SecondMoments moments = path.shares.second_moments();
            const double scale = brightness.scale(path.cell) * path.number;
            for (std::size_t k = 0; k < candidates.size(); ++k) {
                of_choice[k] += scale * moments.choice[k];
                of_connections[k] += scale * moments.connections[k];
            }
        }
    }
    PerCandidate<double> result{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = of_connections[k] > 0.0 ? of_choice[k] / of_connections[k] : 0.0;
    }
    return result;
}

}  // namespace bdpt
