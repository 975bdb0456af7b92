#pragma once

#include <bdpt/types.h>

#include <optional>

namespace bdpt {

struct TileFactors;

/// Receiver for which next-event estimation chooses a light, and a point on it. Evaluating the
/// density of a point requires the same receiver as sampling it.
struct LightSampleContext {
    Vec3 p{0.0f};
    /// Unit normal; light from below it has no effect. nullopt: light from all directions has.
    std::optional<Vec3> normal{};
    /// Learned visibility of the environment's tiles from here; null if unknown. `LightSet` sets it
    /// for the environment.
    const TileFactors* visibility = nullptr;
};

}  // namespace bdpt
