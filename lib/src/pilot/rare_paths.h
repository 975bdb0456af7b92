#pragma once

#include "pilot/pilot_brightness.h"

#include <array>
#include <cstddef>
#include <vector>

namespace bdpt {

/// Errors of a candidate's paths, by their value relative to the local brightness. The brightest
/// paths can be so rare that a usual render shows them as dots in a few pixels, while their squared
/// errors exceed those of all others. The error of a candidate excludes them, up to a limit.
class ErrorsByValue {
public:
    /// Adds paths that a usual render finds `number` times, which bring `value` each, and whose
    /// relMSE is `error`. If `number` is 0, the candidate cannot find them, and `error` always
    /// counts.
    void add(double value, double number, double error) noexcept;
    void add(const ErrorsByValue& other) noexcept;

    /// Returns the sum of all errors but those of the brightest paths: at most `number`, whose
    /// values add up to at most `light`.
    [[nodiscard]] double without_brightest(double number, double light) const noexcept;

private:
    /// Paths whose values have the same power of two.
    struct Octave {
        double number = 0.0;
        double light = 0.0;
        double errors = 0.0;
    };
    static constexpr int least_exponent = -16;

    std::array<Octave, 64> octaves_{};
    double never_found_ = 0.0;  ///< sum of errors
};

/// Number of a usual render's samples per pixel.
inline constexpr double usual_samples = 64.0;

/// Returns the paths that a pilot found by merging, and a usual render finds: camera paths hit a
/// light by way of mirrors or glass so rarely that none of the pilot's own does. The brightest are
/// excluded, as long as a usual render with one light path per camera path would find less than one
/// of them: they do not affect its error.
[[nodiscard]] std::vector<const PilotContribution*> findable_merged_paths(
    const PilotContributions& contributions, const PilotBrightness& brightness);

/// Returns the fraction of the image's light that only merging can find, in [0, 1]: no candidate
/// finds it.
[[nodiscard]] double share_of_merging_alone(const PilotContributions& contributions,
                                            const PilotBrightness& brightness);

}  // namespace bdpt
