#include "pilot/path_shares.h"

#include "math/rgb.h"

#include <limits>

namespace bdpt {
namespace {

/// r of each group (own, splats, connections) and candidate, to some power.
using Factors = std::array<PerCandidate<double>, 3>;

constexpr Factors ratios(int power)
{
    Factors factors{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const std::array<double, 3> samples{PathShares::pilot_light_paths,
                                            candidates[k].light_paths, candidates[k].connections};
        for (std::size_t group = 0; group < samples.size(); ++group) {
            factors[group][k] = 1.0;
            for (int i = 0; i < power; ++i) {
                factors[group][k] *= samples[group] / PathShares::pilot_light_paths;
            }
        }
    }
    return factors;
}
constexpr Factors first = ratios(1);
constexpr Factors second = ratios(2);
constexpr Factors third = ratios(3);

}  // namespace

PathShares::Group PathShares::group_of(int s, int t)
{
    return s <= 1 ? own : t <= 1 ? splats : connections;
}

PathShares::PathShares(const PathContribution& path, Heuristic heuristic)
    : used_share_(path.shares[static_cast<std::size_t>(path.strategy.s)]),
      used_(group_of(path.strategy.s, path.strategy.t)),
      edges_(path.strategy.s + path.strategy.t - 1),
      squares_(heuristic == Heuristic::power)
{
    mean_ = luminance(path.unweighted) * used_share_;
    const int vertices = static_cast<int>(path.shares.size()) - 1;
    float of_camera = 0.0f;
    for (int s = 0; s <= vertices; ++s) {
        const float share = path.shares[static_cast<std::size_t>(s)];
        const Group group = group_of(s, vertices - s);
        of_camera += vertices - s >= 2 ? share : 0.0f;
        raised_[group] += raise(share);
        moments_[group] += squares_ ? share * share * share : share;
    }
    constexpr float often = 0.1f;
    const bool by_camera = path.strategy.t >= 2;
    if (by_camera && of_camera >= often) {
        camera_mean_ = mean_ / of_camera;
    } else if (!by_camera && of_camera < often) {
        splat_mean_ = mean_ / (1.0f - of_camera);
    }
}

PerCandidate<double> PathShares::sums() const
{
    const Factors& raised = squares_ ? second : first;
    const auto of_own = static_cast<double>(raised_[own]);
    const auto of_splats = static_cast<double>(raised_[splats]);
    const auto of_connections = static_cast<double>(raised_[connections]);
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] =
            of_own + raised[splats][k] * of_splats + raised[connections][k] * of_connections;
    }
    return result;
}

PerCandidate<double> PathShares::weights() const
{
    const PerCandidate<double>& ratio = (squares_ ? second : first)[used_];
    const auto share = static_cast<double>(raise(used_share_));
    PerCandidate<double> result = sums();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double sum = result[k];
        result[k] = ratio[k] * share / (sum > 0.0 ? sum : 1.0);
    }
    return result;
}

PathShares::SecondMoments PathShares::second_moments() const
{
    const Factors& factors = squares_ ? third : first;
    const double square = static_cast<double>(mean_) * static_cast<double>(mean_);
    const double of_own = square * static_cast<double>(moments_[own]);
    const double of_splats = square * static_cast<double>(moments_[splats]);
    const double of_connections = square * static_cast<double>(moments_[connections]);
    const PerCandidate<double> all = sums();
    SecondMoments result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double scale = 1.0 / (all[k] > 0.0 ? all[k] * all[k] : 1.0);
        result.own[k] = all[k] > 0.0 ? scale * of_own : std::numeric_limits<double>::infinity();
        result.splats[k] = scale * factors[splats][k] * of_splats;
        result.connections[k] = scale * factors[connections][k] * of_connections;
    }
    return result;
}

}  // namespace bdpt
