#pragma once

#include "pilot/pilot_contributions.h"

#include <array>
#include <cstddef>
#include <vector>

namespace bdpt {

/// Errors of a candidate's paths, by their value relative to the local brightness. The brightest
/// paths can be so rare that a usual render shows them as fireflies in a few pixels, while their
/// squared errors exceed those of all others. The error of a candidate excludes them, up to a
/// limit.
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

/// Returns the paths that a pilot found by merging, and a usual render finds: camera paths hit a
/// light by way of mirrors or glass so rarely that none of the pilot's own does. The brightest are
/// excluded, as long as a usual render with one light path per camera path would find less than one
/// of them: they do not affect its error.
[[nodiscard]] std::vector<const PilotContribution*> findable_merged_paths(
    const PilotContributions& contributions, const PilotBrightness& brightness);

/// Returns the fraction of the image's light that only merging can find, in [0, 1]: no candidate
/// finds it.
[[nodiscard]] double share_of_merging_alone(const PilotContributions& contributions,
                                            const PilotBrightness& brightness);

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
    PerCandidate<double> fireflies{};
};

/// Errors excluding directly visible light.
struct PilotErrors {
    PerCandidate<double> of_image{};  ///< relMSE of one sample per pixel
    /// Covariances of the predictions for two candidates, as far as the paths show them, with the
    /// rare bright ones: the same paths predict both errors.
    PerCandidate<PerCandidate<double>> covariances{};
    /// relMSE of excluded rare bright paths as far as the pilot is sure of it.
    PerCandidate<double> sure_fireflies{};
    CellErrors of_cells;
    bool light_is_rare = false;  ///< `PilotBrightness::light_is_rare`
};

/// Predicts errors of renders.
[[nodiscard]] PilotErrors predict_errors(const PilotContributions& contributions,
                                         const PilotBrightness& brightness);

}  // namespace bdpt
