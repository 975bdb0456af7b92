#pragma once

#include "pilot/candidates.h"

#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// A path that a pilot found, under any numbers of light paths and connections. With a_s = N_s p_s
/// over the sum of all, for the pilot's N, a candidate has r a_s, where r tells how much greater
/// its N is; strategies of one group have one r. Luminance stands for all colors.
class PathShares {
public:
    /// How many light paths of its own a camera path of the pilot has, and is connected to.
    static constexpr int pilot_light_paths = 2;

    /// `heuristic` is balance or power.
    PathShares(const PathContribution& path, Heuristic heuristic);

    /// What the path adds to the mean of its pixel [nit]: if camera paths (t >= 2) find such paths
    /// often enough, they are asked alone, for they come to the very pixel; else splats are.
    [[nodiscard]] double camera_mean() const { return camera_mean_; }
    [[nodiscard]] double splat_mean() const { return splat_mean_; }
    [[nodiscard]] int edges() const { return edges_; }
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

private:
    /// Strategies that take equally many samples: s <= 1; s >= 2 and t <= 1; s, t >= 2.
    enum Group : std::size_t { own, splats, connections, groups };
    using PerGroup = std::array<float, groups>;

    [[nodiscard]] static Group group_of(int s, int t);
    /// What the heuristic makes of a share.
    [[nodiscard]] float raise(float share) const { return squares_ ? share * share : share; }
    /// Sums of raise(r a) over all strategies.
    [[nodiscard]] PerCandidate<double> sums() const;

    float mean_;  ///< by the balance heuristic of all strategies
    float camera_mean_ = 0.0f;
    float splat_mean_ = 0.0f;
    float used_share_;
    Group used_;
    int edges_;
    bool squares_;
    PerGroup raised_{};   ///< sums of raise(a)
    PerGroup moments_{};  ///< sums of raise(a)^2 / a
};

}  // namespace bdpt
