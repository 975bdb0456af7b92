#pragma once

#include "pilot/path_shares.h"

#include <array>
#include <cstddef>

namespace bdpt {

/// What one camera path of a pilot brings to its own pixel, for all candidates at once.
class CandidateMoments {
public:
    /// `path` was found by a strategy with t >= 2; `shares` are its shares.
    void add(const PathContribution& path, const PathShares& shares);

    /// What the candidate's sample brings.
    [[nodiscard]] double value(std::size_t candidate) const;
    /// The second moment of that, without the squares of single paths.
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
        /// Sum of all products of two different values.
        [[nodiscard]] double products() const { return total * total - squares; }
    };

    PerCandidate<Sum> own_{};  ///< of the camera path alone (s <= 1)
    /// Of the connections to each light path, as if it were the only one.
    std::array<PerCandidate<Sum>, PathShares::pilot_connections> connected_{};
};

/// Variance of what the camera paths of a pixel bring, from independent samples.
class VarianceOfSamples {
public:
    void add(const CandidateMoments& sample);
    /// Without the squares of single paths, after `samples` of them, at least two.
    [[nodiscard]] double variance(std::size_t candidate, int samples) const;

private:
    PerCandidate<double> cross_{};
    PerCandidate<double> sums_{};
    PerCandidate<double> squares_{};
};

}  // namespace bdpt
