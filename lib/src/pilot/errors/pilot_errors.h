#pragma once

#include "pilot/pilot_brightness.h"

#include <vector>

namespace bdpt {

/// Errors and costs of the cells of a pilot's grid, by which rates of samples are chosen.
struct CellErrors {
    /// relMSE of one camera sample per pixel, of the pixels of each cell.
    std::vector<PerCandidate<double>> camera;
    /// Cost of a camera sample in each cell, with its share of light paths [unit of the cost
    /// model].
    std::vector<PerCandidate<double>> costs;
    /// 1 for cells where a camera path scatters, 0 where all leave the scene at once: these find no
    /// rare bright paths.
    std::vector<double> scattering;
    /// relMSE of splats of light paths, mean of all pixels: rates do not change their number.
    PerCandidate<double> splats{};
    /// relMSE of the rare bright paths that the error of the image excludes: the pilot does not
    /// know where a render finds them.
    PerCandidate<double> dots{};
};

/// Errors excluding directly visible light.
struct PilotErrors {
    PerCandidate<double> of_image{};  ///< relMSE of one sample per pixel
    /// Covariances of the predictions for two candidates, as far as the paths show them, with the
    /// rare bright ones: the same paths predict both errors.
    PerCandidate<PerCandidate<double>> covariances{};
    /// relMSE of excluded rare bright paths as far as the pilot is sure of it.
    PerCandidate<double> sure_dots{};
    CellErrors of_cells;
    bool light_is_rare = false;  ///< `PilotBrightness::light_is_rare`
};

/// Predicts errors of renders.
[[nodiscard]] PilotErrors predict_errors(const PilotContributions& contributions,
                                         const PilotBrightness& brightness);

}  // namespace bdpt
