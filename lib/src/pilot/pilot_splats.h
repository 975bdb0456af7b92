#pragma once

#include "integrator/integrator.h"
#include "pilot/path_shares.h"
#include "pilot/pilot_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// A path that a pilot found, attributed to the pixels of a cell.
struct PilotContribution {
    std::size_t cell;
    PathShares shares;
    double number = 1.0;  ///< of found paths for which it stands, at least 1
};

/// Splats of a part of a pilot's light paths. They cover the whole image, while the camera paths of
/// a pilot are in one pixel of each cell.
class PilotSplats {
public:
    /// Traces the light paths of sample `index`; the pilot has `light_paths` per pixel of the
    /// image.
    void trace(Integrator& integrator, std::int64_t part, std::int64_t index, const PilotGrid& grid,
               Heuristic heuristic, double light_paths);

    [[nodiscard]] const std::vector<PilotContribution>& contributions() const
    {
        return contributions_;
    }
    [[nodiscard]] const RenderStats& stats() const { return stats_; }

private:
    std::vector<PilotContribution> contributions_;
    RenderStats stats_;
};

}  // namespace bdpt
