#pragma once

#include "pilot/candidates.h"
#include "pilot/pilot_constants.h"

#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// A path that a pilot found, reweighted for any numbers of light paths and connections. With a_s =
/// p_s over the density with which the pilot finds such paths, merges included, a candidate has N_s
/// a_s; N_s is 1 for s = 0, or its number of light samples relative to the pilot's, of light paths
/// or of connections. Luminance represents all channels.
class PathShares {
public:
    /// Number of light paths to which a camera path of the pilot is connected.
    static constexpr int pilot_connections = pilot_constants.sampling.connections;
    /// Its connection rays: so many that nearly all connections are made.
    static constexpr double pilot_rays = pilot_constants.sampling.connection_rays;
    /// Paths by how much Sobol points improve them; those of `seen` lights do not scatter.
    enum Kind : std::size_t { direct, indirect, in_body, seen };
    static constexpr std::size_t scattering_kinds = seen;

    /// The pilot weighted the path by the balance heuristic, and had `light_paths` per pixel of the
    /// image. `heuristic` is that of the candidates, balance or power.
    PathShares(const PathContribution& path, Heuristic heuristic, double light_paths);

    /// Returns the path's contribution to the mean of its pixel [nit]: if camera paths (t >= 2)
    /// find such paths often enough, only they count, for they contribute to that very pixel; else
    /// only splats count.
    [[nodiscard]] double camera_mean() const { return camera_mean_; }
    [[nodiscard]] double splat_mean() const { return splat_mean_; }
    [[nodiscard]] Kind kind() const { return kind_; }
    /// Returns the path's contribution to the mean of its pixel [nit].
    [[nodiscard]] double mean() const { return static_cast<double>(mean_); }
    /// Returns how often one light path per camera path, one light sample of a vertex, and one
    /// connection find such paths, relative to the pilot; 0 if no candidate can.
    [[nodiscard]] double found_by_one() const
    {
        return shares_[own] + shares_[lights] + shares_[splats] + shares_[connections];
    }
    /// Returns how often each candidate finds such paths, relative to the pilot. Each time they
    /// bring the mean over this number, with balance weights.
    [[nodiscard]] PerCandidate<double> numbers() const;
    /// Returns each candidate's weight of the strategy that found the path.
    [[nodiscard]] PerCandidate<double> weights() const;

    /// The path's contribution to the sum of the second moments of all strategies of a candidate,
    /// weighted and divided by their numbers of samples: it stands for the paths that any of them
    /// finds, so that paths rarely found by one are observed by another [Grittmann et al. 2022,
    /// "Efficiency-Aware Multiple Importance Sampling for Bidirectional Rendering Algorithms"].
    struct SecondMoments {
        PerCandidate<double> own;          ///< s <= 1; infinite if the candidate has no such path
        PerCandidate<double> splats;       ///< t <= 1
        PerCandidate<double> connections;  ///< s, t >= 2, if all connections are made
        /// What is added if the candidate chooses among them; 0 if no connection found the path.
        PerCandidate<double> choice;
    };
    [[nodiscard]] SecondMoments second_moments() const;
    /// Returns the contribution of the candidate's strategies with s <= 1 when they find such a
    /// path: their part of the second moment over that of the mean [nit].
    [[nodiscard]] PerCandidate<double> own_values() const;
    /// Returns whether a connection found the path, so that the pilot knows how often candidates
    /// would choose it.
    [[nodiscard]] bool choice_is_known() const { return choice_share_ > 0.0; }

private:
    /// Strategies with the same number of samples: s = 0 and s = t = 1; s = 1 and t >= 2; s >= 2
    /// and t <= 1; s, t >= 2.
    enum Group : std::size_t { own, lights, splats, connections, groups };
    using PerGroup = std::array<double, groups>;

    [[nodiscard]] static Group find_group(int s, int t);
    [[nodiscard]] static Kind find_kind(const PathContribution& path);
    /// Applies the heuristic's function to a share.
    [[nodiscard]] double raise(double share) const { return squares_ ? share * share : share; }
    /// Returns the sums of raise(N a) over all strategies.
    [[nodiscard]] PerCandidate<double> sums() const;

    float mean_;  ///< by the balance heuristic of all strategies and merges
    float camera_mean_ = 0.0f;
    float splat_mean_ = 0.0f;
    double used_share_;
    /// Share of the connection that found the path in the choice among those to the pilot's light
    /// paths; with more light paths it is smaller in proportion. 0 if no connection found it.
    double choice_share_ = 0.0;
    Group used_;
    Kind kind_;
    bool squares_;
    PerGroup shares_{};   ///< sums of a
    PerGroup raised_{};   ///< sums of raise(a)
    PerGroup moments_{};  ///< sums of raise(a)^2 / a
};

/// Contribution of one camera path of a pilot to its own pixel, for all candidates at once.
class CandidateMoments {
public:
    /// Adds `path`, which was found by a strategy with t >= 2; `shares` are its shares.
    void add(const PathContribution& path, const PathShares& shares);

    /// Returns the value of the candidate's sample.
    [[nodiscard]] double value(std::size_t candidate) const;
    /// Returns the part of that value that light samples bring.
    [[nodiscard]] double light_samples(std::size_t candidate) const { return lights_[candidate]; }
    /// Returns the second moment of that value, without the squares of single paths.
    [[nodiscard]] double cross_terms(std::size_t candidate) const;

private:
    struct Sum {
        double total = 0.0;
        double squares = 0.0;
        void add(double value)
        {
            total += value;
            squares += value * value;
        }
        /// Returns the sum of all products of two different values.
        [[nodiscard]] double products() const { return total * total - squares; }
    };

    PerCandidate<Sum> own_{};        ///< contributions of the camera path alone (s <= 1)
    PerCandidate<double> lights_{};  ///< the part of these with s = 1
    /// Contributions of the connections to each light path, as if it were the only one.
    std::array<PerCandidate<Sum>, PathShares::pilot_connections> connected_{};
};

/// Variance of the contributions of a pixel's camera paths, from independent samples.
class VarianceOfSamples {
public:
    void add(const CandidateMoments& sample);
    /// Returns the variance without the squares of single paths, after `samples` samples, at least
    /// two.
    [[nodiscard]] double variance(std::size_t candidate, int samples) const;

private:
    PerCandidate<double> cross_{};
    PerCandidate<double> sums_{};
    PerCandidate<double> squares_{};
    PerCandidate<double> lights_{};
    PerCandidate<double> squares_of_lights_{};
};

}  // namespace bdpt
