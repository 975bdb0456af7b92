#pragma once

/// @file
/// Describes each path that brings light to an image.
///
/// @code{.cpp}
/// void count_splats(bdpt::RenderControl& control, std::atomic<std::int64_t>& splats)
/// {
///     control.on_path = [&splats](const bdpt::PathContribution& path) {  // on many threads
///         if (path.strategy.t <= 1) {
///             ++splats;  // a light path that the lens sees
///         }
///     };
/// }
/// @endcode

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <span>

namespace bdpt {

/// A path that carries light, as sampled by one strategy. The mean of `weight * unweighted` over
/// the samples of a pixel is the pixel's value.
struct PathContribution {
    Strategy strategy;
    /// True if the last light vertex and the last camera vertex were merged into one (vcm).
    bool merged = false;
    int light_path = 0;  ///< index among the light paths of the sample; 0 for s <= 1
    /// Raster position in the pixel it contributes to [pixels, origin at the top left].
    Vec2 raster{0.0f};
    /// Contribution if this were the only strategy, divided by its number of samples [nit].
    Rgb unweighted{0.0f};
    float weight = 1.0f;  ///< MIS weight
    /// Expected number of times that this connection or merge is chosen; 1 for all paths but
    /// connections with `BidirectionalOptions::connection_rays` and merges with `max_merges`.
    float chance = 1.0f;
    /// True if the path scatters within a body, such as wax or skin; provided where `shares` are.
    bool scatters_in_body = false;
    /// Balance-heuristic weight of every strategy for this path, by s, computed from the
    /// definition: N_s p_s over the sum of all; 0 for strategies that cannot sample the path. Where
    /// paths merge, the sum includes merging, so the shares add up to less than one. They are
    /// independent of the heuristic in use, so weights can be checked against them. Only bdpt, lt
    /// and vcm provide them. Valid during the call.
    std::span<const float> shares{};
};

}  // namespace bdpt
