#pragma once

#include "pilot/pilot_contributions.h"

#include <vector>

namespace bdpt {

/// Brightness of the image in each cell and its neighbourhood, estimated from a pilot's
/// contributions: errors are relative to it. A single cell has too few samples: if they happened to
/// be dark, errors of splats would be overestimated by far. The neighbourhood has 3 x 3 cells, more
/// where light is rare in the whole image: relative to a brightness that is its own, each path
/// would have the same error, whatever it brings.
class PilotBrightness {
public:
    explicit PilotBrightness(const PilotContributions& contributions);

    /// Returns the factor of squared errors in relMSE [1/nit^2]; 0 in black images.
    [[nodiscard]] double scale(std::size_t cell) const { return compute_scale(cell, 0.0); }
    /// Returns that factor for the error of a splat of a light path. The splat's own brightness is
    /// excluded: rare splats would hide their own error.
    [[nodiscard]] double scale(const PilotContribution& splat) const
    {
        return compute_scale(splat.cell, splat.shares.splat_mean() * share_of_splat_);
    }

    /// Returns the mean of the image, excluding light that only merging finds [nit].
    [[nodiscard]] double average() const { return average_; }

    /// Returns whether light is so rare in the whole image that much of it, cell by cell, comes
    /// from a single path of the pilot.
    [[nodiscard]] bool light_is_rare() const { return light_is_rare_; }

private:
    [[nodiscard]] double compute_scale(std::size_t cell, double less) const;

    std::vector<double> camera_;  ///< from camera paths [nit]
    std::vector<double> splats_;  ///< from splats [nit]
    double share_of_splat_;       ///< fraction of one splat in `splats_`
    double average_ = 0.0;        ///< mean of the image [nit]
    bool light_is_rare_ = false;  ///< in squares of 3 x 3 cells
};

}  // namespace bdpt
