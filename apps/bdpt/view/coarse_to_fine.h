#pragma once

#include <optional>

#include "options/arguments.h"

namespace bdpt::app {

/// Which coarse pictures come before the render, so that a hand that turns the scene sees it move.
class CoarseToFine {
public:
    /// Something has changed: begins with a picture that will probably take `first_seconds`.
    void restart(const Size& size);
    /// How many pixels of the image the next picture has in one, in width and in height; none: all
    /// were shown, and the render is next.
    [[nodiscard]] std::optional<int> divisor() const;
    /// The next picture is the first since the last restart: it is worth waiting for, as otherwise
    /// a hand that moves on would never see any.
    [[nodiscard]] bool is_first() const { return is_first_; }
    /// The picture of `divisor()` took that long [s].
    void done(double seconds);
    /// Leaves the rest out.
    void skip() { divisor_.reset(); }

    static constexpr double first_seconds = 0.04;
    static constexpr double max_seconds = 0.25;  ///< of any of them

private:
    /// What one with that divisor will probably take [s].
    [[nodiscard]] double seconds(int divisor) const;

    Size size_{};
    double seconds_a_pixel_ = 5e-6;  ///< measured; a guess until the first picture is done
    std::optional<int> divisor_{};
    bool is_first_ = false;
};

/// The size of the picture with that divisor: at least one pixel.
[[nodiscard]] Size coarse_size(const Size& size, int divisor);

}  // namespace bdpt::app
