#pragma once

#include "pilot/path_shares.h"

#include <array>
#include <cstddef>

namespace bdpt {

/// Contribution of one camera path of a pilot to its own pixel, for all candidates at once.
class CandidateMoments {
public:
    /// Adds `path`, which was found by a strategy with t >= 2; `shares` are its shares.
    void add(const PathContribution& path, const PathShares& shares);

    /// Returns the value of the candidate's sample.
    [[nodiscard]] double value(std::size_t candidate) const;
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

    PerCandidate<Sum> own_{};  ///< contributions of the camera path alone (s <= 1)
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
};

}  // namespace bdpt
