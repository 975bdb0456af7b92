#include "pilot/path_shares.h"

#include "math/rgb.h"

#include <algorithm>
#include <limits>

namespace bdpt {
namespace {

/// N of each group (own, lights, splats, connections) and candidate, to some power.
using Factors = std::array<PerCandidate<double>, 4>;

constexpr Factors numbers(int power)
{
    Factors factors{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const std::array<double, 4> samples{1.0, candidates[k].light_samples,
                                            candidates[k].light_paths, candidates[k].connections};
        for (std::size_t group = 0; group < samples.size(); ++group) {
            factors[group][k] = 1.0;
            for (int i = 0; i < power; ++i) {
                factors[group][k] *= samples[group];
            }
        }
    }
    return factors;
}

constexpr Factors first = numbers(1);
constexpr Factors second = numbers(2);
constexpr Factors third = numbers(3);

}  // namespace

PathShares::Group PathShares::find_group(int s, int t)
{
    return s == 0 || (s == 1 && t == 1) ? own : s == 1 ? lights : t <= 1 ? splats : connections;
}

PathShares::Kind PathShares::find_kind(const PathContribution& path)
{
    const std::size_t edges = path.shares.size() - 2;
    return path.scatters_in_body ? in_body : edges < 2 ? seen : edges == 2 ? direct : indirect;
}

PathShares::PathShares(const PathContribution& path, Heuristic heuristic, double light_paths)
    : used_(find_group(path.strategy.s, path.strategy.t)),
      kind_(find_kind(path)),
      squares_(heuristic == Heuristic::power)
{
    const PerGroup samples{1.0, 1.0, light_paths, pilot_connections};
    const float found = path.shares[static_cast<std::size_t>(path.strategy.s)];
    used_share_ = static_cast<double>(found) / samples[used_];
    mean_ = luminance(path.unweighted) * (path.merged ? path.chance * path.weight : found);
    if (used_ == connections && !path.merged) {
        choice_share_ = static_cast<double>(path.chance) / pilot_rays;
    }
    const int vertices = static_cast<int>(path.shares.size()) - 1;
    float of_light = 0.0f;
    for (int s = 0; s <= vertices; ++s) {
        const Group group = find_group(s, vertices - s);
        of_light += vertices - s <= 1 ? path.shares[static_cast<std::size_t>(s)] : 0.0f;
        const double share =
            static_cast<double>(path.shares[static_cast<std::size_t>(s)]) / samples[group];
        shares_[group] += share;
        raised_[group] += raise(share);
        moments_[group] += squares_ ? share * share * share : share;
    }
    if (!(found_by_one() > 0.0)) {
        return;  // only merging finds it
    }
    constexpr float often = pilot_constants.sampling.often;
    const float of_camera = 1.0f - of_light;
    const bool by_camera = path.strategy.t >= 2;
    if (by_camera && of_camera >= often) {
        camera_mean_ = mean_ / of_camera;
    } else if (!by_camera && of_camera < often) {
        splat_mean_ = mean_ / of_light;
    }
}

PerCandidate<double> PathShares::numbers() const
{
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = shares_[own] + first[lights][k] * shares_[lights] +
                    first[splats][k] * shares_[splats] +
                    first[connections][k] * shares_[connections];
    }
    return result;
}

PerCandidate<double> PathShares::sums() const
{
    const Factors& raised = squares_ ? second : first;
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = raised_[own] + raised[lights][k] * raised_[lights] +
                    raised[splats][k] * raised_[splats] +
                    raised[connections][k] * raised_[connections];
    }
    return result;
}

PerCandidate<double> PathShares::weights() const
{
    const PerCandidate<double>& ratio = (squares_ ? second : first)[used_];
    const double share = raise(used_share_);
    PerCandidate<double> result = sums();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double sum = result[k];
        result[k] = ratio[k] * share / (sum > 0.0 ? sum : 1.0);
    }
    return result;
}

PerCandidate<double> PathShares::own_values() const
{
    const PerCandidate<double>& of_mean = (squares_ ? second : first)[lights];
    const PerCandidate<double>& of_square = (squares_ ? third : first)[lights];
    PerCandidate<double> result = sums();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double mean = result[k] * (raised_[own] + of_mean[k] * raised_[lights]);
        const double square = moments_[own] + of_square[k] * moments_[lights];
        result[k] = mean > 0.0 ? static_cast<double>(mean_) * square / mean : 0.0;
    }
    return result;
}

PathShares::SecondMoments PathShares::second_moments() const
{
    const Factors& factors = squares_ ? third : first;
    const double square = static_cast<double>(mean_) * static_cast<double>(mean_);
    const double of_hits = square * moments_[own];
    const double of_lights = square * moments_[lights];
    const double of_splats = square * moments_[splats];
    const double of_connections = square * moments_[connections];
    const PerCandidate<double> all = sums();
    SecondMoments result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double scale = 1.0 / (all[k] > 0.0 ? all[k] * all[k] : 1.0);
        result.own[k] = all[k] > 0.0 ? scale * (of_hits + factors[lights][k] * of_lights)
                                     : std::numeric_limits<double>::infinity();
        result.splats[k] = scale * factors[splats][k] * of_splats;
        result.connections[k] = scale * factors[connections][k] * of_connections;
        // Chosen with a chance below 1, a contribution is divided by it.
        const double chance = candidates[k].connection_rays * choice_share_ * pilot_connections /
                              std::max(1.0, candidates[k].connections);
        const bool rare = chance > 0.0 && chance < 1.0;
        result.choice[k] = rare ? result.connections[k] * (1.0 / chance - 1.0) : 0.0;
    }
    return result;
}

void CandidateMoments::add(const PathContribution& path, const PathShares& shares)
{
    const auto unweighted = static_cast<double>(luminance(path.unweighted));
    const PerCandidate<double> weights = shares.weights();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double weighted = weights[k] * unweighted;
        if (path.strategy.s <= 1) {
            own_[k].add(weighted);
            lights_[k] += path.strategy.s == 1 ? weighted : 0.0;
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
        const double lights = sample.light_samples(k);
        lights_[k] += lights;
        squares_of_lights_[k] += lights * lights;
    }
}

double VarianceOfSamples::variance(std::size_t k, int samples) const
{
    // Products of different samples: an unbiased estimate of the mean's square.
    const double pairs = static_cast<double>(samples) * (samples - 1);
    const double mean_square = (sums_[k] * sums_[k] - squares_[k]) / pairs;
    // Products of different light samples of a vertex, of which the pilot has one, as if they were
    // independent; points of one vertex are so well distributed that no more is left.
    const double of_lights = (1.0 - 1.0 / candidates[k].light_samples) *
                             (lights_[k] * lights_[k] - squares_of_lights_[k]) / pairs;
    return cross_[k] / samples + of_lights - mean_square;
}

}  // namespace bdpt
