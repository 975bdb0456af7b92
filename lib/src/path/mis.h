#pragma once

#include "math/pdf.h"

#include <bdpt/render_options.h>

#include <cstddef>
#include <span>

namespace bdpt {

/// All sampling densities of one full path x_0 .. x_{n-1}; x_0 is on the light, x_{n-1} on the
/// lens.
struct PathDensities {
    std::span<const AreaPdf>
        from_light;  ///< n: x_i sampled from x_{i-1}; x_0 as a light path's start
    std::span<const AreaPdf> from_camera;  ///< n: x_i sampled from x_{i+1}
    AreaPdf next_event;  ///< x_0 sampled from x_1 by next-event estimation (s = 1)
    /// n + 1: how many samples the strategy with s light vertices takes for each camera path; 0
    /// when it cannot make this path.
    std::span<const float> sample_counts;
    /// n, or none if nothing merges: `Merging::weight` where both walks may sample x_i and merge
    /// there, times its opacity [m^2]; 0 where they do not.
    std::span<const float> merge_weights{};
};

/// N_s p_s of the strategy with `s` light vertices: the product of all densities, in long double
/// for its range. Has the same rounding whoever asks.
[[nodiscard]] long double strategy_density(const PathDensities& path, std::size_t s);

/// That of all strategies, by s, with one product from each end in place of one for each strategy:
/// the last digits differ. `densities` has room for n + 1. Returns the sum over all merges:
/// `merge_weights[i]` times the density of both walks having sampled x_i [Georgiev et al. 2012,
/// eq. 6].
long double strategy_densities(const PathDensities& path, std::span<long double> densities);

/// Weight of the strategy that sampled the first `s` vertices from the light [Veach 1997,
/// sec. 10.2]. A pure function of the path: the weights of all possible strategies of a path add up
/// to one. `sample_counts[s]` is not 0.
[[nodiscard]] float mis_weight(const PathDensities& path, int s, Heuristic heuristic);

/// The same of having merged at x_i, which counts with a density of `merge_weights[i]` times that
/// of both walks having sampled x_i [Georgiev et al. 2012, eq. 6]. `heuristic` is balance or power;
/// `merge_weights[i]` is not 0.
[[nodiscard]] float merge_weight(const PathDensities& path, int i, Heuristic heuristic);

}  // namespace bdpt
