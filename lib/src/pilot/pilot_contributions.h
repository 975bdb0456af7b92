#pragma once

#include "pilot/pilot_grid.h"
#include "pilot/pilot_row.h"
#include "pilot/pilot_splats.h"

#include <vector>

namespace bdpt {

/// All that a pilot has found.
struct PilotContributions {
    PilotGrid grid;
    double light_paths;  ///< for each pixel of the image
    std::vector<PilotRow> rows;
    std::vector<PilotSplats> parts;  ///< of its light paths

    /// A find of camera paths counts for one of so many samples of a pixel.
    [[nodiscard]] double camera_paths() const
    {
        return static_cast<double>(grid.cells()) * PilotRow::samples_of_cell;
    }
    /// A splat of a light path counts for one of so many: all pixels have got it in each sample.
    [[nodiscard]] double splatted_pixels() const
    {
        return grid.pixels() * PilotRow::samples_of_cell;
    }
};

}  // namespace bdpt
