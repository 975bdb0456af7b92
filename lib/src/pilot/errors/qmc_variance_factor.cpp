#include "pilot/errors/qmc_variance_factor.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

// Sobol points leave a fraction of the variance of independent samples, as measured in the
// project's scenes with 32 samples: a small one for direct light, a larger one for the rest; splats
// do not benefit, nor do paths in bodies that scatter light: their integrands have too many
// dimensions and peaks.
constexpr double left_of_direct = 0.25;
constexpr double left_of_connections = 0.3;
constexpr double left_of_choice = 0.2;  // of what the choice of connections adds

/// Returns the remaining fraction for paths that camera paths find alone: 1 for rare paths, as a
/// single sample is not stratified. `value` is the path's contribution relative to the local
/// brightness: at most one in that many samples finds one.
double left_of_own(const PathShares& shares, double value)
{
    if (shares.kind() == PathShares::in_body) {
        return 1.0;
    }
    if (shares.kind() == PathShares::direct) {
        return left_of_direct;
    }
    constexpr double least = 0.3;
    constexpr double rare = 4.0;
    return least + (1.0 - least) * value / (value + rare);
}

/// Returns the remaining fraction by number of connections: more connections of a sample are more
/// points of one sequence, which reduce the remaining variance of each.
PerCandidate<double> left_by_more_connections()
{
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const auto c = static_cast<float>(std::max(1.0, candidates[k].connections));
        result[k] = exp_exact(-log_exact(c) / 3.0f);
    }
    return result;
}

}  // namespace

RemainingErrors remaining_errors(const PathShares& shares, double scale,
                                 const PerCandidate<double>& choice)
{
    RemainingErrors result;
    if (shares.kind() == PathShares::seen) {
        return result;  // directly visible light is accounted for separately
    }
    const double per_brightness = std::sqrt(scale);
    const PathShares::SecondMoments moments = shares.second_moments();
    const PerCandidate<double> values = shares.own_values();
    static const PerCandidate<double> of_connections = left_by_more_connections();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double own = left_of_own(shares, values[k] * per_brightness);
        const double connections =
            shares.kind() == PathShares::in_body ? 1.0 : left_of_connections * of_connections[k];
        const double of_choice =
            shares.choice_is_known() ? moments.choice[k] : choice[k] * moments.connections[k];
        result.camera[k] = scale * (own * moments.own[k] + connections * moments.connections[k] +
                                    left_of_choice * of_choice);
        result.splats[k] = scale * moments.splats[k];
    }
    return result;
}

}  // namespace bdpt
