#pragma once

#include "pilot/candidates.h"
#include "pilot/pilot_errors.h"
#include "pilot/pilot_rates.h"

#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <memory>
#include <stop_token>

namespace bdpt {

struct LearnedLight;
class MovingCamera;
class World;

/// Predictions of a pilot.
struct PilotResult {
    /// relMSE of one sample per pixel, excluding directly visible light.
    PerCandidate<double> errors{};
    PerCandidate<PerCandidate<double>> covariances{};  ///< `PilotErrors::covariances`
    VisibleLightErrors visible_lights;                 ///< errors of directly visible light
    PerCandidate<double> dots{};   ///< `PilotErrors::sure_dots`, which `errors` excludes
    PerCandidate<double> costs{};  ///< cost of a sample [ns on the machine of the cost model]
    /// Fraction of the light that no candidate finds, in [0, 1].
    double merging_alone = 0.0;
    bool light_is_rare = false;  ///< `PilotBrightness::light_is_rare`
    CellErrors cells;            ///< errors of parts of the image
    RenderStats stats;           ///< work of the pilot itself
};

/// Renders a few samples all over the whole image with light paths of their own, and predicts error
/// and cost of every candidate from them. Its random numbers are its own. The result depends on
/// scene, camera, size of the film and transport options, but not on seed, samples, crop or
/// threads. `camera` is that of the whole image, `visibility` the learned visibility for it. Once
/// `abandon` is requested it returns soon, with a meaningless result.
[[nodiscard]] PilotResult run_pilot(const World& world, const MovingCamera& camera,
                                    const RenderOptions& options,
                                    const LearnedLight* learned = nullptr,
                                    const std::stop_token& abandon = {});

/// Returns `options` with the integrator and the numbers that have the smallest error at equal cost
/// in `pilot`, among those that fit into `light_path_memory`. Chosen connections, and more than one
/// light path, are taken only for a gain that exceeds the noise of the prediction.
[[nodiscard]] RenderOptions with_best(const PilotResult& pilot, const RenderOptions& options);

/// Returns rates of samples for the options that with_best() returned; null if they gain too
/// little, or if light is so rare that the pilot does not know errors of parts of the image.
[[nodiscard]] std::shared_ptr<const SampleRates> best_rates(const PilotResult& pilot,
                                                            const RenderOptions& chosen);

}  // namespace bdpt
