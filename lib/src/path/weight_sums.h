#pragma once

#include "path/densities.h"
#include "path/path_vertex.h"
#include "path/strategy_set.h"

#include <cstddef>
#include <span>

namespace bdpt {

class Camera;

/// Densities that a connection adds to those of the two walks: at the ends and their neighbours,
/// whose next vertex has changed.
struct JoinDensities {
    AreaPdf light_at_camera_end;       ///< z_{t-1} sampled from y_{s-1}
    AreaPdf light_at_camera_neighbor;  ///< z_{t-2} sampled from z_{t-1}
    AreaPdf camera_at_light_end;       ///< y_{s-1} sampled from z_{t-1}
    AreaPdf camera_at_light_neighbor;  ///< y_{s-2} sampled from y_{s-1}
    AreaPdf next_event;                ///< x_0 sampled from x_1 by next-event estimation
};

/// Balance and power heuristics in constant time per connection: each vertex of a subpath stores
/// the weights of all strategies that move it and any number of its predecessors to the other
/// subpath, for unknown densities of itself and its predecessor from the other side. A connection
/// multiplies them by these densities, the only ones that it changes [Georgiev 2012, "Implementing
/// Vertex Connection and Merging", sec. 4]. Equals `mis_weight` up to rounding.
class WeightSums {
public:
    /// Tests whether the strategies can be weighted this way.
    [[nodiscard]] static bool applies(const StrategySet& strategies, Heuristic heuristic);
    /// Requires `applies`. `merge_weight` is `Merging::weight`. `world` must outlive this object,
    /// which is immutable.
    WeightSums(const World& world, const Camera& camera, const StrategySet& strategies,
               Heuristic heuristic, double merge_weight);

    /// Stores the sums of a whole subpath, whose prefixes can then be weighted.
    void sum_camera_path(std::span<PathVertex> path) const;
    void sum_light_path(std::span<PathVertex> path) const;

    /// Returns the weight like `PathWeigher::weight`, for paths of three vertices and more.
    [[nodiscard]] float weight(std::span<const PathVertex> light,
                               std::span<const PathVertex> camera, const JoinDensities& join) const;
    /// Returns the weight like `PathWeigher::weight_of_merge`.
    [[nodiscard]] float weight_of_merge(std::span<const PathVertex> light,
                                        std::span<const PathVertex> camera,
                                        const JoinDensities& join) const;

private:
    /// Stores the sums of vertex k of a subpath. `term` is the sum of the terms of connecting its
    /// predecessor to it and of merging at it; for k = 0, that of a walk from the other side that
    /// hits it.
    void store_sums(std::span<PathVertex> path, std::size_t k, double term) const;

    [[nodiscard]] double raise(double value) const;
    [[nodiscard]] double raise(AreaPdf pdf) const;
    /// Returns the term of a strategy that connects light paths to these two vertices (s, t >= 2).
    [[nodiscard]] double connection_term(const PathVertex& a, const PathVertex& b) const
    {
        if (a.kind != VertexKind::medium && b.kind != VertexKind::medium) [[likely]] {
            return joins_;
        }
        return joins_ * raise(static_cast<double>(connection_count(world_, a, b)));
    }
    [[nodiscard]] double camera_term(std::span<const PathVertex> camera,
                                     const PathVertex& next) const;
    [[nodiscard]] double light_term(std::span<const PathVertex> light,
                                    const PathVertex& next) const;
    [[nodiscard]] double merge_term(const PathVertex& vertex, AreaPdf pdf) const;
    [[nodiscard]] double lens_sum(const PathVertex& lens, AreaPdf pdf_rev) const;

    const World& world_;
    bool squares_;
    bool finite_lens_;
    double merge_weight_;
    double splats_;  ///< the heuristic's function of the number of samples with s >= 2, t <= 1
    double joins_;   ///< likewise with s >= 2, t >= 2
    double light_samples_;  ///< likewise with s = 1, t >= 2; for s = 0 it is one
};

}  // namespace bdpt
