#pragma once

#include "pilot/candidates.h"

#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// A path that a pilot found, under any numbers of light paths and connections. With a_s = p_s over
/// the density with which the pilot finds such paths, merges too, a candidate has N_s a_s; N_s is 1
/// for s <= 1, or its number of light paths or of connections. Luminance stands for all colors.
class PathShares {
public:
    /// To how many light paths a camera path of the pilot is connected.
    static constexpr int pilot_connections = 2;

    /// The pilot weighed the path by the balance heuristic, and had so many `light_paths` for each
    /// pixel of the image. `heuristic` is that of the candidates, balance or power.
    PathShares(const PathContribution& path, Heuristic heuristic, double light_paths);

    /// What the path adds to the mean of its pixel [nit]: if camera paths (t >= 2) find such paths
    /// often enough, they are asked alone, for they come to the very pixel; else splats are.
    [[nodiscard]] double camera_mean() const { return camera_mean_; }
    [[nodiscard]] double splat_mean() const { return splat_mean_; }
    [[nodiscard]] int edges() const { return edges_; }
    /// What the path adds to the mean of its pixel if merging alone can find it [nit], else 0.
    [[nodiscard]] double merged_mean() const
    {
        return found_by_one_ > 0.0 ? 0.0 : static_cast<double>(mean_);
    }
    /// How often one light path for each camera path, and one connection, finds such paths, for
    /// each one that the pilot finds; 0 if no candidate can.
    [[nodiscard]] double found_by_one() const { return found_by_one_; }
    /// What such a path is worth when it is found like that, and by balance [nit].
    [[nodiscard]] double value() const
    {
        return found_by_one_ > 0.0 ? static_cast<double>(mean_) / found_by_one_ : 0.0;
    }
    /// Each candidate's weight of the strategy that found the path.
    [[nodiscard]] PerCandidate<double> weights() const;

    /// What the path adds to the sum of the second moments of all strategies of a candidate,
    /// weighted and divided by their numbers of samples: it stands for the paths that any of them
    /// finds, so that rare finds of one are seen by another [Grittmann et al. 2022,
    /// "Efficiency-Aware Multiple Importance Sampling for Bidirectional Rendering Algorithms"].
    struct SecondMoments {
        PerCandidate<double> own;          ///< s <= 1; infinite if the candidate has no such path
        PerCandidate<double> splats;       ///< t <= 1
        PerCandidate<double> connections;  ///< s, t >= 2
    };
    [[nodiscard]] SecondMoments second_moments() const;
    /// What the candidate's strategies with s <= 1 bring when they find such a path: their part of
    /// the second moment over that of the mean [nit].
    [[nodiscard]] PerCandidate<double> own_values() const;

private:
    /// Strategies that take equally many samples: s <= 1; s >= 2 and t <= 1; s, t >= 2.
    enum Group : std::size_t { own, splats, connections, groups };
    using PerGroup = std::array<double, groups>;

    [[nodiscard]] static Group group_of(int s, int t);
    /// What the heuristic makes of a share.
    [[nodiscard]] double raise(double share) const { return squares_ ? share * share : share; }
    /// Sums of raise(N a) over all strategies.
    [[nodiscard]] PerCandidate<double> sums() const;

    float mean_;  ///< by the balance heuristic of all strategies and merges
    double found_by_one_ = 0.0;
    float camera_mean_ = 0.0f;
    float splat_mean_ = 0.0f;
    double used_share_;
    Group used_;
    int edges_;
    bool squares_;
    PerGroup raised_{};   ///< sums of raise(a)
    PerGroup moments_{};  ///< sums of raise(a)^2 / a
};

}  // namespace bdpt
