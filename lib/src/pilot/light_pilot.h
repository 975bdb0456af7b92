#pragma once

#include "light/learned/learned_light.h"
#include "light/light_samples.h"
#include "math/distributions.h"

#include <bdpt/render_options.h>

#include <memory>
#include <optional>
#include <span>
#include <stop_token>

namespace bdpt {

class LightSet;
class MovingCamera;
class World;

/// Returns the number of the light pilot's camera paths along each side of the image; 0 if so few
/// samples are planned that learning is not worth its time.
[[nodiscard]] int light_pilot_side(const RenderOptions& options);

/// Tests whether learning can help this render: it needs enough planned samples, an environment,
/// several groups of lights, or light paths and a sun or several lamps; no fog, an integrator with
/// other techniques that find rare light, and options that request it
/// (`EnvironmentSampling::learned`).
[[nodiscard]] bool can_learn_light(const World& world, const RenderOptions& options);

/// Traces camera paths all over the image and records the contributions of light samples at their
/// vertices, the lights that they hit, and from where rays reach the environment and suns. Returns
/// null if that does not help: unless `can_learn_light`, and if nearly all of a single environment
/// is visible everywhere; also once `abandon` is requested. A pure function of scene, camera, size
/// of the film and transport options: independent of seed, samples, crop and threads. `camera` is
/// that of the whole image.
[[nodiscard]] std::unique_ptr<const LearnedLight> learn_light(const World& world,
                                                              const MovingCamera& camera,
                                                              const RenderOptions& options,
                                                              const std::stop_token& abandon = {});

/// A contribution of one light to the image, after at least one bounce that a light path can
/// replace, as a camera path of a pilot found it.
struct IndirectLight {
    LightId light{};
    float value = 0.0f;  ///< luminance, >= 0 and finite
};

/// Returns the table that chooses the light of each light path, by what a pilot found
/// (docs/decisions/0075-learned-starts.md); nullopt if nothing was found. Each light that has power
/// keeps a part of its probability by power.
[[nodiscard]] std::optional<AliasTable> learn_starts(std::span<const IndirectLight> found,
                                                     const LightSet& lights);

}  // namespace bdpt
