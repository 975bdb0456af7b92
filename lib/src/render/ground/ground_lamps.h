#pragma once

#include "render/ground/ground_occluders.h"
#include "scene/light_set.h"

#include <cstddef>
#include <vector>

namespace bdpt {

/// How often lights that have a place are sampled on the ground: rarely where they bring next to
/// nothing beside the rest (docs/decisions/0064).
class GroundLamps {
public:
    /// `elsewhere`: the luminance of the irradiance of all other lights [lx].
    GroundLamps(const LightSet& lights, const GroundOccluders& occluders, float height,
                float elsewhere);

    /// The probability of taking a sample, in [1 / 16, 1].
    [[nodiscard]] float chance(std::size_t place) const
    {
        return chances_.empty() ? 1.0f : chances_[place];
    }

private:
    std::vector<float> chances_;  ///< by place; empty: 1 everywhere
};

}  // namespace bdpt
