#pragma once

#include "pilot/candidates.h"
#include "pilot/pilot_constants.h"
#include "pilot/pilot_errors.h"

#include <bdpt/part/sample_rates.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <cstddef>
#include <memory>
#include <stop_token>

namespace bdpt {

struct LearnedLight;
class MovingCamera;
class World;

/// What a pilot observed, from which `choose` takes a candidate.
struct PilotMeasurements {
    /// relMSE of one sample per pixel, excluding directly visible light.
    PerCandidate<double> errors{};
    PerCandidate<PerCandidate<double>> covariances{};  ///< `PilotErrors::covariances`
    VisibleLightErrors visible_lights;                 ///< errors of directly visible light
    PerCandidate<double> fireflies{};  ///< `PilotErrors::sure_fireflies`, which `errors` excludes
    PerCandidate<double> costs{};      ///< cost of a sample [ns on the machine of the cost model]
    /// Light paths need more than `light_path_memory`, or the candidate is not suitable.
    PerCandidate<bool> ruled_out{};
    /// Fraction of the light that no candidate finds, in [0, 1].
    double merging_alone = 0.0;
    bool light_is_rare = false;  ///< `PilotBrightness::light_is_rare`
    PilotGrid grid{1, 1};
    CellErrors cells;   ///< errors of parts of the image
    RenderStats stats;  ///< work of the pilot itself
};

/// Returns the number of camera samples that are planned for the whole image; infinite if it is not
/// known.
[[nodiscard]] double planned_paths(const RenderOptions& options);

/// Tests whether so many samples are planned that a pilot is worth its time.
[[nodiscard]] bool is_worth_measuring(const RenderOptions& options);

/// Renders a few samples all over the whole image with light paths of their own, and predicts error
/// and cost of every candidate from them. Its random numbers are its own. The result depends on
/// scene, camera, size of the film, planned samples and transport options, but not on seed,
/// samples, crop or threads. `camera` is that of the whole image, `learned` the light that is
/// learned for it. Once `abandon` is requested it returns soon, with a meaningless result.
[[nodiscard]] PilotMeasurements measure(const World& world, const MovingCamera& camera,
                                        const RenderOptions& options,
                                        const LearnedLight* learned = nullptr,
                                        const std::stop_token& abandon = {});

/// Returns `options` with the integrator and the numbers of the candidate.
[[nodiscard]] RenderOptions with_candidate(RenderOptions options, const Candidate& candidate);

/// Returns the candidate of `among` that has the smallest error at equal cost, of those whose light
/// paths fit into memory; the first one always does. Chosen connections, and more than one light
/// path, are taken only for a gain that exceeds the noise of the prediction.
[[nodiscard]] std::size_t choose(const PilotMeasurements& pilot,
                                 const PerCandidate<Candidate>& among = candidates,
                                 const ChoiceConstants& constants = pilot_constants.choice);

/// Returns rates of samples from 1/2 to 2 for a render by that candidate: in proportion to the root
/// of error over cost (Neyman's allocation) of cells, and changing slowly from pixel to pixel. Null
/// if they would gain too little over equal numbers of samples, which are better distributed, or if
/// light is so rare that the pilot does not know errors of parts of the image.
[[nodiscard]] std::shared_ptr<const SampleRates> choose_rates(const PilotMeasurements& pilot,
                                                              std::size_t candidate);

}  // namespace bdpt
