#pragma once

#include "math/pdf.h"
#include "path/path_vertex.h"
#include "path/strategy_set.h"
#include "path/weight_sums.h"

#include <bdpt/render_options.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

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

class Camera;

/// Gathers the densities of complete paths and computes MIS weights. Holds the arrays, so that a
/// thread allocates them once.
class PathWeigher {
public:
    /// `strategies` and `camera` must outlive this object; `merge_weight` is `Merging::weight`.
    PathWeigher(const World& world, const Camera& camera, const StrategySet& strategies,
                Heuristic heuristic, int max_vertices, double merge_weight = 0.0);

    /// Precomputes the sums that the weights of all prefixes of a subpath share, where possible.
    /// Afterwards every call of `weight` must be for such prefixes; otherwise each call gathers all
    /// densities.
    void begin_camera_path(std::span<PathVertex> path);
    void begin_light_path(std::span<PathVertex> path);

    /// Tests whether camera walks (s = 0) are the only strategy for paths of one edge from the
    /// light, so that each has weight 1 and needs no densities. False if `shares()` needs them.
    [[nodiscard]] bool is_seen_by_walks_alone(LightId light) const;

    /// Gathers the densities of every path, for `shares()`.
    void keep_paths() { keeps_paths_ = true; }

    /// Returns the weight of connecting the first s light vertices to the first t camera vertices.
    /// For s = 0 the last camera vertex is x_0.
    [[nodiscard]] float weight(std::span<const PathVertex> light,
                               std::span<const PathVertex> camera, const JoinDensities& join);
    /// Returns the weight of a light walk of n - 1 vertices that hits the lens (t = 0).
    [[nodiscard]] float weight_of_hit(std::span<const PathVertex> light, const PathVertex& lens,
                                      const JoinDensities& join);

    /// Returns the weight of merging the last of the first s light vertices with the last of the
    /// first t camera vertices; the path keeps the latter. `join` connects the light vertices
    /// before it to the camera vertices.
    [[nodiscard]] float weight_of_merge(std::span<const PathVertex> light,
                                        std::span<const PathVertex> camera,
                                        const JoinDensities& join);

    /// Returns the densities behind the last weight(), if no subpath was begun or paths are kept.
    [[nodiscard]] PathDensities last_path() const;
    /// Returns the balance heuristic of all strategies of the last path, by number of light
    /// vertices, computed from the definition [Veach 1997, eq. 9.8]; the difference of their sum
    /// from one is the share of merging. Valid until the next path.
    [[nodiscard]] std::span<const float> shares();
    /// Tests whether a vertex of the last path whose densities were gathered is a scattering event
    /// in a body.
    [[nodiscard]] bool scatters_in_body() const { return scatters_in_body_; }

    [[nodiscard]] NextEventSampling next_event_sampling() const
    {
        return strategies_.next_event_sampling();
    }

private:
    enum class Made { by_join, by_hit, by_merge };

    void gather_densities(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                          const JoinDensities& join);
    void gather_sample_counts(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                              Made made);

    const World& world_;
    const Camera& camera_;
    const StrategySet& strategies_;
    Heuristic heuristic_;
    std::vector<AreaPdf> from_light_;
    std::vector<AreaPdf> from_camera_;
    std::vector<float> sample_counts_;
    std::vector<float> merge_weights_;
    double merge_weight_;
    AreaPdf next_event_;
    std::size_t size_ = 0;
    std::optional<WeightSums> sums_;
    bool uses_sums_ = false;
    bool keeps_paths_ = false;
    bool scatters_in_body_ = false;
    /// Densities of strategies, from which `shares_` is computed.
    std::vector<long double> densities_;
    std::vector<float> shares_;
};

}  // namespace bdpt
