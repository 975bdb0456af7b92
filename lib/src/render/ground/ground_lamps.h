#pragma once

#include "render/ground/ground_occluders.h"
#include "scene/light_set.h"

#include <cstddef>
#include <vector>

namespace bdpt {

/// Sampling probabilities of lights with a position on the ground: low where their contribution is
/// negligible (docs/decisions/0064).
class GroundLamps {
public:
    /// `elsewhere` is the luminance of the irradiance of all other lights [lx].
    GroundLamps(const LightSet& lights, const GroundOccluders& occluders, float height,
                float elsewhere);

    /// Returns the probability of taking a sample, in [1 / 128, 1].
    [[nodiscard]] float chance(std::size_t place) const
    {
        return chances_.empty() ? 1.0f : chances_[place];
    }

private:
    std::vector<float> chances_;  ///< one per place; empty: 1 everywhere
};

}  // namespace bdpt
