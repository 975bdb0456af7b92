#include "pilot/errors/choice_noise.h"

#include "geometry/flush_denormals.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

/// Second moments of paths that connections found.
struct ChoiceMoments {
    PerCandidate<double> choice{};
    PerCandidate<double> connections{};

    void add(const PerCandidate<double>& of_choice, const PerCandidate<double>& of_connections,
             double scale)
    {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            choice[k] += scale * of_choice[k];
            connections[k] += scale * of_connections[k];
        }
    }
};

ChoiceMoments moments_of(const PilotRow& row, const PilotBrightness& brightness)
{
    ChoiceMoments sum;
    for (const PilotContribution& path : row.joined()) {
        if (path.shares.choice_is_known()) {
            const PathShares::SecondMoments moments = path.shares.second_moments();
            sum.add(moments.choice, moments.connections, brightness.scale(path.cell) * path.number);
        }
    }
    return sum;
}

}  // namespace

PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                    const PilotBrightness& brightness)
{
    std::vector<ChoiceMoments> rows(contributions.rows.size());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
        const FlushDenormals flush;
        rows[i] = moments_of(contributions.rows[i], brightness);
    });
    ChoiceMoments all;
    for (const ChoiceMoments& row : rows) {
        all.add(row.choice, row.connections, 1.0);
    }
    PerCandidate<double> result{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = all.connections[k] > 0.0 ? all.choice[k] / all.connections[k] : 0.0;
    }
    return result;
}

}  // namespace bdpt
