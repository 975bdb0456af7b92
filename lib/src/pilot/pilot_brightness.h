#pragma once

#include "pilot/pilot_contributions.h"

#include <vector>

namespace bdpt {

/// How bright the image is in each cell and those around it, by what a pilot found: errors are
/// relative to it. A cell alone has too few samples: where they happen to be dark, errors that
/// splats bring would count far too much.
class PilotBrightness {
public:
    explicit PilotBrightness(const PilotContributions& contributions);

    /// What relMSE multiplies a square of an error by [1/nit^2]; 0 in black images.
    [[nodiscard]] double scale(std::size_t cell) const { return scale_of(cell, 0.0); }
    /// The same for an error that comes from that splat of a light path. What it brings itself does
    /// not count: rare splats would hide their own error.
    [[nodiscard]] double scale(const PilotContribution& splat) const
    {
        return scale_of(splat.cell, splat.shares.splat_mean() * share_of_splat_);
    }

    /// Mean of the image, but for light that merging alone finds [nit].
    [[nodiscard]] double average() const { return average_; }

private:
    [[nodiscard]] double scale_of(std::size_t cell, double less) const;

    std::vector<double> camera_;  ///< by camera paths [nit]
    std::vector<double> splats_;  ///< by splats [nit]
    double share_of_splat_;       ///< of one splat in these
    double average_ = 0.0;        ///< of the image [nit]
};

}  // namespace bdpt
