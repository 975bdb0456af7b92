#include "pilot/path_shares.h"

#include "math/rgb.h"

#include <limits>

namespace bdpt {

PathShares::Group PathShares::group_of(int s, int t)
{
    return s <= 1 ? own : t <= 1 ? splats : connections;
}

PathShares::PerGroup PathShares::ratios(const Candidate& candidate)
{
    return {1.0f, static_cast<float>(candidate.light_paths / pilot_light_paths),
            static_cast<float>(candidate.connections / pilot_light_paths)};
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

float PathShares::sum(const PerGroup& ratio) const
{
    float result = 0.0f;
    for (std::size_t g = 0; g < groups; ++g) {
        result += raise(ratio[g]) * raised_[g];
    }
    return result;
}

double PathShares::weight(const Candidate& candidate) const
{
    const PerGroup ratio = ratios(candidate);
    const float all = sum(ratio);
    return all > 0.0f ? static_cast<double>(raise(ratio[used_] * used_share_) / all) : 0.0;
}

PathShares::SecondMoments PathShares::second_moments(const Candidate& candidate) const
{
    const PerGroup ratio = ratios(candidate);
    const auto all = static_cast<double>(sum(ratio));
    if (all == 0.0) {
        return {.own = std::numeric_limits<double>::infinity()};
    }
    const auto part = [&](Group group) {
        const float r = ratio[group];
        return static_cast<double>((squares_ ? r * r * r : r) * moments_[group]);
    };
    const double scale = static_cast<double>(mean_) * static_cast<double>(mean_) / (all * all);
    return {.own = scale * part(own),
            .splats = scale * part(splats),
            .connections = scale * part(connections)};
}

}  // namespace bdpt
