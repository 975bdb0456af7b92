#pragma once

#include <bdpt/render_options.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// How a camera path comes to a point of a light from its vertex before that.
enum class LightTechnique : std::size_t {
    light_sample,  ///< next-event estimation at the vertex
    bsdf_sample,   ///< the ray that goes on from the vertex hits the light
    fog_sample     ///< the vertex itself was chosen for the light, in fog
};

/// How often each finds it: densities in one measure times numbers of samples, >= 0; by
/// `LightTechnique`.
using TechniqueDensities = std::array<float, 3>;

/// The weight of the one in use [Veach 1997, sec. 9.2]. Those of all add up to one.
[[nodiscard]] float mis_weight(const TechniqueDensities& densities, LightTechnique used,
                               Heuristic heuristic);

}  // namespace bdpt
