#pragma once

#include "path/path_vertex.h"
#include "path/strategy_set.h"

#include <span>
#include <vector>

namespace bdpt {

class Camera;

/// What joining two subpaths adds to the densities that the walks have stored: those of the ends
/// and of their neighbours, which now see a new vertex.
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
    /// It `applies`. `world` must outlive this object.
    WeightSums(const World& world, const Camera& camera, const StrategySet& strategies,
               Heuristic heuristic);

    /// Sums over the whole subpaths, whose prefixes are weighed next.
    void begin_camera_path(std::span<const PathVertex> path);
    void begin_light_path(std::span<const PathVertex> path);

    /// As `PathWeigher::weight`, for paths of three vertices and more.
    [[nodiscard]] float weight(std::span<const PathVertex> light,
                               std::span<const PathVertex> camera, const JoinDensities& join) const;

private:
    [[nodiscard]] double raise(double ratio) const;
    [[nodiscard]] double lens_term(AreaPdf from_light, const PathVertex& lens) const;
    [[nodiscard]] double hit_term(AreaPdf from_camera, const PathVertex& x0) const;
    /// Of the strategies that take more than the end from the camera subpath; `neighbor` is the
    /// density of z_{t-2} as sampled from there.
    [[nodiscard]] double beyond_camera_end(std::span<const PathVertex> camera,
                                           AreaPdf neighbor) const;
    [[nodiscard]] double light_side(std::span<const PathVertex> light,
                                    const JoinDensities& join) const;

    const World& world_;
    bool squares_;
    bool finite_lens_;
    double light_paths_;  ///< what counts for each strategy with s >= 2
    /// For vertex k: the sum over all strategies that sample it from the other side, and any number
    /// of vertices before it, relative to the strategy that samples them from this side.
    std::vector<double> camera_sums_;
    std::vector<double> light_sums_;
    double next_event_term_ = 0.0;  ///< s = 1 against s = 2, of the light path at hand
};

}  // namespace bdpt
