#pragma once

#include "pilot/pilot_grid.h"
#include "pilot/pilot_row.h"
#include "pilot/pilot_splats.h"

#include <vector>

namespace bdpt {

/// All contributions that a pilot has found.
struct PilotContributions {
    PilotGrid grid;
    double light_paths;  ///< light paths per pixel of the image
    std::vector<PilotRow> rows;
    std::vector<PilotSplats> parts;  ///< splats of its light paths

    /// Returns the number of camera paths over which their contributions are averaged.
    [[nodiscard]] double camera_paths() const
    {
        return static_cast<double>(grid.cells()) * PilotRow::samples_of_cell;
    }
    /// Returns the number of pixel samples over which splats of light paths are averaged: each
    /// sample covers all pixels.
    [[nodiscard]] double splatted_pixels() const
    {
        return grid.pixels() * PilotRow::samples_of_cell;
    }
};

}  // namespace bdpt
