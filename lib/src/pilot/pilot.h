#pragma once

#include "pilot/candidates.h"
#include "pilot/visible_lights.h"

#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <stop_token>

namespace bdpt {

class EnvironmentVisibility;
class MovingCamera;
class World;

/// What a pilot predicts.
struct PilotResult {
    /// relMSE of one sample per pixel, but for light that is seen directly.
    PerCandidate<double> errors{};
    VisibleLightErrors visible_lights;  ///< of that light
    PerCandidate<double> costs{};       ///< of a sample [ns on the machine that has the prices]
    double merging_alone = 0.0;         ///< share of the light that no candidate finds, in [0, 1]
    RenderStats stats;                  ///< of the pilot itself
};

/// Renders a few samples all over the whole image with light paths of their own, and predicts from
/// them error and cost of every candidate. Its random numbers are its own. What it returns depends
/// on scene, camera, size of the film and options of transport, but not on seed, samples, crop or
/// threads. `camera` is that of the whole image, `visibility` what was learned for it. Once
/// `abandon` is requested it returns soon, with a result that is worth nothing.
[[nodiscard]] PilotResult run_pilot(const World& world, const MovingCamera& camera,
                                    const RenderOptions& options,
                                    const EnvironmentVisibility* visibility = nullptr,
                                    const std::stop_token& abandon = {});

/// `options` with the integrator and the numbers that have the least error at equal cost in
/// `pilot`, of those that fit into `light_path_memory`.
[[nodiscard]] RenderOptions with_best(const PilotResult& pilot, const RenderOptions& options);

}  // namespace bdpt
