#pragma once

#include <array>
#include <cstddef>

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

}  // namespace bdpt
