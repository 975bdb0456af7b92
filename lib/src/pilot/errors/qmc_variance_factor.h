#pragma once

#include "pilot/path_shares.h"

#include <array>
#include <cstddef>

namespace bdpt {

/// Contribution of a path to the errors that remain with well-distributed random numbers: relMSE.
struct RemainingErrors {
    PerCandidate<double> camera{};  ///< of camera paths (t >= 2)
    PerCandidate<double> splats{};  ///< of light paths (t <= 1)

    [[nodiscard]] double sum(std::size_t candidate) const
    {
        return camera[candidate] + splats[candidate];
    }
};

/// `scale` is the factor of squared errors in relMSE [1/nit^2]. `choice` is the ratio of
/// `measure_choice`, which is used for paths that no connection found.
[[nodiscard]] RemainingErrors remaining_errors(const PathShares& shares, double scale,
                                               const PerCandidate<double>& choice);

/// Remaining fractions of the variances of sums of paths of each kind.
inline constexpr std::array<double, PathShares::scattering_kinds> left_of_sums{0.25, 0.4, 1.0};

}  // namespace bdpt
