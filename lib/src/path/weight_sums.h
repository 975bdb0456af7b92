#pragma once

#include "path/path_vertex.h"
#include "path/strategy_set.h"

#include <cstddef>
#include <span>

namespace bdpt {

class Camera;

/// The densities that a join of two subpaths adds to those of the walks: those of the ends and of
/// their neighbours, which now see a new vertex.
struct JoinDensities {
    AreaPdf light_at_camera_end;       ///< z_{t-1} sampled from y_{s-1}
    AreaPdf light_at_camera_neighbor;  ///< z_{t-2} sampled from z_{t-1}
    AreaPdf camera_at_light_end;       ///< y_{s-1} sampled from z_{t-1}
    AreaPdf camera_at_light_neighbor;  ///< y_{s-2} sampled from y_{s-1}
    AreaPdf next_event;                ///< x_0 sampled from x_1 by next-event estimation
};

/// The balance and power heuristics in constant time a join: the share of all strategies that a
/// subpath could hand vertices over to is summed up once for each of its vertices, and a join adds
/// the two vertices at either end whose densities it changes [Georgiev 2012, "Implementing Vertex
/// Connection and Merging", sec. 4]. Gives what `mis_weight` gives, up to rounding.
class WeightSums {
public:
    /// Can it weigh these strategies?
    [[nodiscard]] static bool applies(const StrategySet& strategies, Heuristic heuristic);
    /// It `applies`. `merge_weight` is `Merging::weight`. `world` must outlive this object, which
    /// nothing changes.
    WeightSums(const World& world, const Camera& camera, const StrategySet& strategies,
               Heuristic heuristic, double merge_weight);

    /// Sum over whole subpaths, whose prefixes can then be weighed.
    void sum_camera_path(std::span<PathVertex> path) const;
    void sum_light_path(std::span<PathVertex> path) const;

    /// As `PathWeigher::weight`, for paths of three vertices and more.
    [[nodiscard]] float weight(std::span<const PathVertex> light,
                               std::span<const PathVertex> camera, const JoinDensities& join) const;
    /// As `PathWeigher::weight_of_merge`.
    [[nodiscard]] float weight_of_merge(std::span<const PathVertex> light,
                                        std::span<const PathVertex> camera,
                                        const JoinDensities& join) const;

private:
    // The sum of vertex k of a subpath: over all strategies that sample it from the other side, and
    // any number of vertices before it, what the heuristic makes of count times density, relative
    // to sampling them from this side. Strategies that merge at one of these vertices sample it
    // from both sides. `pdf_rev` is its density from the other side; `joins`: can a strategy join
    // there; `before` is the sum of vertex k - 1.
    [[nodiscard]] double camera_sum(std::span<const PathVertex> camera, std::size_t k,
                                    AreaPdf pdf_rev, bool joins, double before) const;
    [[nodiscard]] double light_sum(std::span<const PathVertex> light, std::size_t k,
                                   AreaPdf pdf_rev, bool joins, double before) const;
    /// That of the vertex before the end of a subpath; 0 if there is none.
    [[nodiscard]] double beyond_camera_end(std::span<const PathVertex> camera,
                                           AreaPdf pdf_rev) const;
    [[nodiscard]] double beyond_light_end(std::span<const PathVertex> light, AreaPdf pdf_rev) const;

    [[nodiscard]] double raise(double ratio) const;
    [[nodiscard]] double camera_term(bool joins, std::size_t t) const;
    [[nodiscard]] double light_term(const PathVertex& x0, bool joins, std::size_t s) const;
    [[nodiscard]] double merge_term(const PathVertex& vertex, AreaPdf pdf, bool joins) const;

    const World& world_;
    bool squares_;
    bool finite_lens_;
    double merge_weight_;
    double splats_;  ///< what the heuristic makes of the number of samples with s >= 2, t <= 1
    double joins_;   ///< and of those with s >= 2, t >= 2
    double light_samples_;  ///< and of s = 1, t >= 2; that of s = 0 is one
};

}  // namespace bdpt
