#include "pilot/candidate_moments.h"

#include "math/rgb.h"

#include <algorithm>

namespace bdpt {
void CandidateMoments::add(const PathContribution& path, const PathShares& shares)
{
    const auto unweighted = static_cast<double>(luminance(path.unweighted));
    const PerCandidate<double> weights = shares.weights();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double weighted = weights[k] * unweighted;
        if (path.strategy.s <= 1) {
            own_[k].add(weighted);
        } else {
            connected_[static_cast<std::size_t>(path.light_path)][k].add(
                weighted * PathShares::pilot_connections);
        }
    }
}

double CandidateMoments::value(std::size_t k) const
{
    const bool connects = candidates[k].connections > 0.0;
    const double both = connected_[0][k].total + connected_[1][k].total;
    return own_[k].total + (connects ? 0.5 * both : 0.0);
}

double CandidateMoments::cross_terms(std::size_t k) const
{
    // E[(A + (B_1 + ... + B_c) / c)^2] without squares of single paths. Below one connection, only
    // the fraction c of the camera paths has one.
    const double c = candidates[k].connections;
    const Sum& own = own_[k];
    if (c == 0.0) {
        return own.products();
    }
    const Sum& first = connected_[0][k];
    const Sum& second = connected_[1][k];
    return own.products() + own.total * (first.total + second.total) +
           0.5 * (first.products() + second.products()) / c +
           std::max(0.0, 1.0 - 1.0 / c) * first.total * second.total;
}

void VarianceOfSamples::add(const CandidateMoments& sample)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        cross_[k] += sample.cross_terms(k);
        const double value = sample.value(k);
        sums_[k] += value;
        squares_[k] += value * value;
    }
}

double VarianceOfSamples::variance(std::size_t k, int samples) const
{
    // Products of different samples: an unbiased estimate of the mean's square.
    return cross_[k] / samples -
           (sums_[k] * sums_[k] - squares_[k]) / (static_cast<double>(samples) * (samples - 1));
}

}  // namespace bdpt
