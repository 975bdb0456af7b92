#pragma once

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
    walk,     ///< subpaths: random numbers, rays, sampling of lights, BSDFs and the lens
    shade,    ///< surfaces that walks meet: materials, textures, emission
    connect,  ///< joins: points on lights and lenses, values of BSDFs, shadow rays
    weigh,    ///< how strategies share a path
    splat,    ///< adding to the film and to images of strategies
};

/// In the order of the enumerators.
inline constexpr std::array all_phases{Phase::walk, Phase::shade, Phase::connect, Phase::weigh,
                                       Phase::splat};

/// The enumerator's own name.
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

/// Where the time of a render's samples went, added up over all threads. AOVs are not in it, nor is
/// time in which a thread had no processor, as far as the system tells. All zero when no sample was
/// clocked.
struct TimeProfile {
    /// The time of all samples by phase [s]. About every sixteenth sample, chosen at random, is
    /// clocked in phases, and the time of reading the clock is subtracted from each. The sum is the
    /// time that all samples would take if none were clocked.
    std::array<double, all_phases.size()> phase_seconds{};
    std::uint64_t samples = 0;          ///< of pixels
    std::uint64_t clocked_samples = 0;  ///< of these, in phases
    double clock_seconds = 0.0;         ///< what all reading of the clock took, about [s]
    /// How many times longer than others a clocked sample took, after subtraction of the clock; 1
    /// when clocking a phase does not change how long it takes. 0 when there were not both kinds.
    double distortion = 0.0;
    PixelRect region;                  ///< of the film
    std::vector<float> pixel_seconds;  ///< mean over a pixel's samples [s], top row first

    [[nodiscard]] double seconds(Phase phase) const
    {
        return phase_seconds[static_cast<std::size_t>(phase)];
    }
    /// The time of all phases [s].
    [[nodiscard]] double total() const
    {
        return std::accumulate(phase_seconds.begin(), phase_seconds.end(), 0.0);
    }
    /// The share of a phase in the total, in [0, 1].
    [[nodiscard]] double share(Phase phase) const
    {
        return total() > 0.0 ? seconds(phase) / total() : 0.0;
    }
};

}  // namespace bdpt
