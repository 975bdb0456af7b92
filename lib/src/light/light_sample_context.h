#pragma once

#include <bdpt/types.h>

#include <optional>

namespace bdpt {

struct TileFactors;

/// A point that next-event estimation chooses a light for, and a point of that. Whoever evaluates
/// the density of a certain point has to state the same receiver as whoever samples it.
struct LightSampleContext {
    Vec3 p{0.0f};
    /// Unit; light from below it brings nothing. None: light from all around does.
    std::optional<Vec3> normal{};
    /// How visible the tiles of the environment are from here, if that was learned. `LightSet`
    /// fills it in for the environment.
    const TileFactors* visibility = nullptr;
};

}  // namespace bdpt
