#pragma once

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <span>

namespace bdpt {

/// A path that brings light, as one strategy found it. The mean over the samples of a pixel of
/// `weight * unweighted` is the pixel.
struct PathContribution {
    Strategy strategy;
    /// The last light vertex and the last camera vertex count as one (vcm).
    bool merged = false;
    int light_path = 0;    ///< of the sample's light paths, which one it is about; 0 for s <= 1
    Vec2 raster{0.0f};     ///< in the pixel that it counts for [pixels, origin at the top left]
    Rgb unweighted{0.0f};  ///< if the strategy were alone, divided by its number of samples [nit]
    float weight = 1.0f;   ///< by MIS
    /// Shares of all strategies of this path by the balance heuristic, from their definition, by s:
    /// N_s p_s over the sum of all; 0 for those that cannot make the path. Where paths
    /// merge, the sum holds that, too, so the shares add up to less than one. They hold for
    /// any heuristic in use, so weights can be held against them. Only bdpt, lt and vcm know them.
    /// Valid during the call.
    std::span<const float> shares{};
};

}  // namespace bdpt
