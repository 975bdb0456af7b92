#pragma once

/// @file
/// Tells where the time of a render's samples goes.
///
/// @code{.cpp}
/// void print_profile(const bdpt::TimeProfile& profile)  // of a render with Profiling::on
/// {
///     for (const bdpt::Phase phase : bdpt::all_phases) {
///         std::cout << bdpt::to_string(phase) << ": " << profile.seconds(phase) << " s\n";
///     }
/// }
/// @endcode

#include <bdpt/pixel_rect.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <vector>

namespace bdpt {

/// The phases of a sample.
enum class Phase : std::uint8_t {
    walk,     ///< tracing subpaths: random numbers, rays, sampling of lights, BSDFs and the lens
    shade,    ///< shading surfaces that walks hit: materials, textures, emission
    connect,  ///< connecting: points on lights and lenses, BSDF values, shadow rays
    weigh,    ///< computing MIS weights
    splat,    ///< adding to the film and to strategy images
};

/// All phases, in the order of the enumerators.
inline constexpr std::array all_phases{Phase::walk, Phase::shade, Phase::connect, Phase::weigh,
                                       Phase::splat};

/// Returns the enumerator's own name.
[[nodiscard]] constexpr std::string_view to_string(Phase phase)
{
    switch (phase) {
        case Phase::walk:
            return "walk";
        case Phase::shade:
            return "shade";
        case Phase::connect:
            return "connect";
        case Phase::weigh:
            return "weigh";
        case Phase::splat:
            break;
    }
    return "splat";
}

/// Time of a render's samples by phase, summed over all threads. It excludes AOVs, and time during
/// which a thread had no processor, as far as the system reports it. All zero if no sample was
/// timed.
struct TimeProfile {
    /// Time of all samples by phase [s]. About every sixteenth sample, chosen at random, is timed
    /// by phase, and the time of reading the clock is subtracted from each. The sum estimates the
    /// time of all samples if none were timed by phase.
    std::array<double, all_phases.size()> phase_seconds{};
    std::uint64_t samples = 0;          ///< samples of pixels
    std::uint64_t clocked_samples = 0;  ///< samples that were timed by phase
    double clock_seconds = 0.0;         ///< approximate time spent reading the clock [s]
    /// Ratio of the time of a sample timed by phase, after subtraction of the clock, to that of
    /// other samples; 1 if timing does not change the time of a phase. 0 if there were not both
    /// kinds.
    double distortion = 0.0;
    PixelRect region;                  ///< region of the film
    std::vector<float> pixel_seconds;  ///< mean time of a pixel's samples [s], top row first

    [[nodiscard]] double seconds(Phase phase) const
    {
        return phase_seconds[static_cast<std::size_t>(phase)];
    }
    /// Returns the time of all phases [s].
    [[nodiscard]] double total() const
    {
        return std::accumulate(phase_seconds.begin(), phase_seconds.end(), 0.0);
    }
    /// Returns the fraction of the total that a phase took, in [0, 1].
    [[nodiscard]] double share(Phase phase) const
    {
        return total() > 0.0 ? seconds(phase) / total() : 0.0;
    }
};

}  // namespace bdpt
