#pragma once

#include <bdpt/render_options.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// Technique by which a camera path connects its vertex to a point on a light.
enum class LightTechnique : std::size_t {
    light_sample,  ///< next-event estimation at the vertex
    bsdf_sample,   ///< the ray sampled by the BSDF at the vertex hits the light
    fog_sample     ///< the vertex itself was sampled by the light, in fog
};

/// Densities of the techniques in one measure, times their numbers of samples, >= 0; indexed by
/// `LightTechnique`.
using TechniqueDensities = std::array<float, 3>;

/// Returns the weight of the used technique [Veach 1997, sec. 9.2]. The weights of all techniques
/// add up to one.
[[nodiscard]] float mis_weight(const TechniqueDensities& densities, LightTechnique used,
                               Heuristic heuristic);

}  // namespace bdpt
