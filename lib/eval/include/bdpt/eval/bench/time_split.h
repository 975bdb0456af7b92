#pragma once

/// @file
/// Tells where the time of an integrator goes in a scene.
///
/// @code{.cpp}
/// void print_split(const bdpt::eval::TimeSplit& split)
/// {
///     for (std::size_t i = 0; i < split.shares.size(); ++i) {
///         std::cout << bdpt::to_string(bdpt::all_phases[i]) << ": " << split.shares[i] << '\n';
///     }
/// }
/// @endcode

#include <bdpt/render_options.h>
#include <bdpt/time_profile.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt::eval {

/// Time by phase of an integrator's samples in a scene, from a separate render that counts in none
/// of the comparisons.
struct TimeSplit {
    IntegratorKind integrator = IntegratorKind::bdpt;
    /// Fraction of the time by phase; they sum to 1.
    std::array<double, all_phases.size()> shares{};
    double sample_seconds = 0.0;  ///< mean thread time of one sample of a pixel [s]
    std::int64_t samples = 0;     ///< per pixel
    double distortion = 0.0;      ///< `TimeProfile::distortion`
};

}  // namespace bdpt::eval
