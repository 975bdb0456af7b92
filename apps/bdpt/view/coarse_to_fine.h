#pragma once

#include <optional>

#include "options/arguments.h"

namespace bdpt::app {

/// Sequence of coarse pictures before the render, so that the scene moves smoothly under the user's
/// hand.
class CoarseToFine {
public:
    /// Starts again after a change, with a picture that should take about `first_seconds`.
    void restart(const Size& size);
    /// Returns the size of the next picture's pixels in pixels of the image, in width and in
    /// height; none: all pictures were shown, and the render is next.
    [[nodiscard]] std::optional<int> divisor() const;
    /// Tests whether the next picture is the first since the last restart. It should not be
    /// abandoned, as otherwise nothing is shown during a continuous motion.
    [[nodiscard]] bool is_first() const { return is_first_; }
    /// Reports that the picture of `divisor()` took this time [s].
    void done(double seconds);
    /// Skips the remaining pictures.
    void skip() { divisor_.reset(); }

    static constexpr double first_seconds = 0.04;
    static constexpr double max_seconds = 0.25;  ///< maximum of any picture

private:
    /// Returns the expected time of a picture with that divisor [s].
    [[nodiscard]] double seconds(int divisor) const;

    Size size_{};
    double seconds_a_pixel_ = 5e-6;  ///< measured; a guess until the first picture is done
    std::optional<int> divisor_{};
    bool is_first_ = false;
};

/// Returns the size of the picture with that divisor: at least one pixel.
[[nodiscard]] Size coarse_size(const Size& size, int divisor);

}  // namespace bdpt::app
