#pragma once

#include "pilot/path_shares.h"
#include "pilot/pilot_brightness.h"

#include <array>
#include <cstddef>
#include <vector>

namespace bdpt {

/// Returns the second moments that the choice of connections adds, over those of all connections,
/// for each candidate. The pilot's connections tell it for the paths that they found; it is assumed
/// for paths that other strategies found.
[[nodiscard]] PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                                  const PilotBrightness& brightness);

/// Contribution of a path to the errors that remain with well-distributed random numbers: relMSE.
struct RemainingErrors {
    PerCandidate<double> camera{};  ///< of camera paths (t >= 2)
    PerCandidate<double> splats{};  ///< of light paths (t <= 1)

    [[nodiscard]] double sum(std::size_t candidate) const
    {
        return camera[candidate] + splats[candidate];
    }
};

/// `scale` is the factor of squared errors in relMSE [1/nit^2]. `choice` is the ratio of
/// `measure_choice`, which is used for paths that no connection found.
[[nodiscard]] RemainingErrors remaining_errors(const PathShares& shares, double scale,
                                               const PerCandidate<double>& choice);

/// Remaining fractions of the variances of sums of paths of each kind.
inline constexpr std::array<double, PathShares::scattering_kinds> left_of_sums{0.25, 0.4, 1.0};

/// Errors of directly visible light: relMSE of one sample per pixel, of this light alone.
struct VisibleLightErrors {
    double by_hits = 0.0;  ///< camera paths have to hit the light (s = 0)
    double by_both = 0.0;  ///< points on lights are also connected to the lens (s = t = 1)
};

/// Computes the errors of renders with `options` from points on lights that a pilot has seen, one
/// for each of its samples. Camera paths miss lights that fill a small part of a pixel; those that
/// fill it they cannot miss.
[[nodiscard]] VisibleLightErrors visible_light_errors(const PilotContributions& contributions,
                                                      const PilotBrightness& brightness,
                                                      const RenderOptions& options);

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
