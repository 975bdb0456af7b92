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
        from_light;  ///< n: x_i sampled from x_{i-1}; x_0 as start of a light path
    std::span<const AreaPdf> from_camera;  ///< n: x_i sampled from x_{i+1}
    AreaPdf next_event;  ///< x_0 sampled from x_1 by next-event estimation (s = 1)
    /// n + 1: number of samples that the strategy with s light vertices takes per camera path; 0 if
    /// it cannot sample this path.
    std::span<const float> sample_counts;
    /// n, or empty if nothing merges: `Merging::weight` where both walks may sample x_i and merge
    /// there, times its opacity [m^2]; 0 elsewhere.
    std::span<const float> merge_weights{};
};

/// Returns N_s p_s of the strategy with `s` light vertices: the product of all densities, in long
/// double for its range. Its rounding is the same for all callers.
[[nodiscard]] long double strategy_density(const PathDensities& path, std::size_t s);

/// Computes `strategy_density` for all strategies, by s, with one product from each end instead of
/// one per strategy: the last digits differ. `densities` has room for n + 1. Returns the sum over
/// all merges: `merge_weights[i]` times the density with which both walks sample x_i [Georgiev et
/// al. 2012, eq. 6].
long double strategy_densities(const PathDensities& path, std::span<long double> densities);

/// Returns the weight of the strategy that sampled the first `s` vertices from the light [Veach
/// 1997, sec. 10.2]. A pure function of the path: the weights of all possible strategies of a path
/// add up to one. `sample_counts[s]` is not 0.
[[nodiscard]] float mis_weight(const PathDensities& path, int s, Heuristic heuristic);

/// Returns the weight of merging at x_i, whose density is `merge_weights[i]` times that of both
/// walks sampling x_i [Georgiev et al. 2012, eq. 6]. `heuristic` is balance or power;
/// `merge_weights[i]` is not 0.
[[nodiscard]] float merge_weight(const PathDensities& path, int i, Heuristic heuristic);

}  // namespace bdpt
